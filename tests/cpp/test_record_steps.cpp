// The steps of a whole record against those of the schemes, one by one.

#include "record_steps.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "kernel_runs.hpp"
#include "probation/companion/power_law.hpp"
#include "probation/companion/weissenberg.hpp"

using namespace probation;
using Eigen::ArrayXd;
using Eigen::Index;

namespace {

constexpr Scheme schemes[] = {Scheme::be2, Scheme::sa2, Scheme::sa3};

Law law_by_rate() {
  Law law;
  law.unrelaxed_modulus = 3000.0;
  law.hardening_modulus = 2.5;
  law.companion = std::make_shared<Weissenberg>(0.00464, 0.0367);
  return law;
}

/// Steps that differ, one of them six times as long as the one before, even ones at the end.
ArrayXd steps_of_all_kinds() {
  ArrayXd time(600);
  time[0] = 0.0;
  for (Index i = 1; i < time.size(); ++i)
    time[i] = time[i - 1] + (i == 40   ? 3.0
                             : i > 300 ? 0.5
                                       : 0.5 + 0.2 * std::sin(static_cast<double>(i * i)));
  return time;
}

ArrayXd strain_at(const ArrayXd& time) { return 0.004 * time + 0.05 * (0.03 * time).sin(); }
ArrayXd rate_at(const ArrayXd& time) { return 0.004 + 0.0015 * (0.03 * time).cos(); }

/// Two jumps in a row, one in the middle of a part and one on its end.
History::Indices jumps() { return {0, 20, 21, 256, 257, 500}; }

void check_steps(const Law& law, const History& history, Scheme scheme) {
  RecordRates rates;
  RecordInputs<double> in;
  form_inputs(law, {}, history, scheme, rates, in);
  RecordSteps<double> formed;
  form_steps(scheme, Start::exponential, history, in, formed);
  // Of a run of even steps a kernel reads the first scale, ratio and curvature alone.
  std::vector<bool> read(static_cast<std::size_t>(history.steps()), true);
  for_each_run(history, formed.rule, in.fluidity_end.size() == 1,
               [&](Index first, Index count, bool uniform) {
                 for (Index m = first + 1; uniform && m < first + count; ++m)
                   read[static_cast<std::size_t>(m)] = false;
               });
  StepForcing<double> one{};
  for (Index m = 0; m < history.steps(); ++m) {
    const auto i = static_cast<std::size_t>(m);
    one = step_forcing(scheme, Start::exponential, step_data(history, in, m, one.scale, one.forcing));
    CHECK(formed.rule[i] == one.rule);
    CHECK(std::abs(formed.forcing[i] - one.forcing) < 1e-10);
    if (!read[i]) continue;
    if (one.rule == StepRule::bdf2) CHECK(formed.ratio[i] == doctest::Approx(history.ratio(m)).epsilon(1e-9));
    CHECK(formed.scale[i] == doctest::Approx(one.scale).epsilon(1e-13));
    if (scheme == Scheme::sa3) CHECK(std::abs(formed.curvature[i] - one.curvature) < 1e-10);
  }
}

}  // namespace

TEST_CASE("steps formed at once are those formed one by one: any lengths, jumps, rates given or not") {
  const ArrayXd time = steps_of_all_kinds(), even = ArrayXd::LinSpaced(600, 0.0, 300.0);
  Law constant = law_by_rate();
  constant.companion = nullptr;
  constant.tau_max = 5.2;
  for (const Scheme scheme : schemes)
    for (const Law& law : {law_by_rate(), constant})
      for (const ArrayXd& t : {time, even})
        for (const ArrayXd& rate : {ArrayXd(), rate_at(t)})
          check_steps(law, History(t, strain_at(t), rate, jumps()), scheme);
}

TEST_CASE("what is kept of a record's rates is forgotten with the relation it was made by") {
  const ArrayXd time = steps_of_all_kinds();
  const History history(time, strain_at(time));
  Law law = law_by_rate();
  RecordRates rates;
  RecordInputs<double> in;
  form_inputs(law, {}, history, Scheme::sa2, rates, in);
  law.companion = std::make_shared<PowerLaw>(0.03, -1.0);
  law.alpha = 2.0;
  form_inputs(law, {}, history, Scheme::sa2, rates, in);
  const StepRates seen = history.rates(Differentiator::three_point);
  for (Index m = 0; m < history.steps(); ++m) {
    const auto i = static_cast<std::size_t>(m);
    CHECK(in.fluidity_begin[i] == doctest::Approx(seen.begin[m] / 0.06).epsilon(1e-13));
    CHECK(in.fluidity_end[i] == doctest::Approx(seen.end[m] / 0.06).epsilon(1e-13));
  }
}
