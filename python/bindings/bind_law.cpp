#include "bindings.hpp"
#include "probation/law.hpp"

using namespace probation;

void bind_law(py::module_& m) {
  py::class_<Law>(m, "Law")
      .def(py::init([](double unrelaxed_modulus, double hardening_modulus, double tau_max, double alpha,
                       std::shared_ptr<CompanionRelation> companion, const Spectrum& spectrum) {
             Law law{unrelaxed_modulus, hardening_modulus, tau_max, alpha, std::move(companion), spectrum};
             law.validate();
             return law;
           }),
           "unrelaxed_modulus"_a, "hardening_modulus"_a, "tau_max"_a, "alpha"_a, "companion"_a, "spectrum"_a)
      .def_readonly("unrelaxed_modulus", &Law::unrelaxed_modulus)
      .def_readonly("hardening_modulus", &Law::hardening_modulus)
      .def_readonly("tau_max", &Law::tau_max)
      .def_readonly("alpha", &Law::alpha)
      .def_readonly("spectrum", &Law::spectrum);

  py::class_<LawChange>(m, "LawChange")
      .def(py::init<>())
      .def_readwrite("relaxation_time_factor", &LawChange::relaxation_time_factor)
      .def_readwrite("unrelaxed_modulus_factor", &LawChange::unrelaxed_modulus_factor)
      .def_readwrite("hardening_factor", &LawChange::hardening_factor)
      .def_readwrite("added_relaxed_stress", &LawChange::added_relaxed_stress)
      .def_readwrite("load_bearing_area", &LawChange::load_bearing_area)
      .def_readwrite("initial_modal_stress", &LawChange::initial_modal_stress)
      .def_property(
          "extra_modulus", [](const LawChange& change) { return change.extra_modes.modulus; },
          [](LawChange& change, const Eigen::ArrayXd& modulus) { change.extra_modes.modulus = modulus; })
      .def_property(
          "extra_relaxation_time", [](const LawChange& change) { return change.extra_modes.relaxation_time; },
          [](LawChange& change, const Eigen::ArrayXd& time) { change.extra_modes.relaxation_time = time; })
      .def_property(
          "feedbacks",
          [](const LawChange& change) {
            std::vector<std::shared_ptr<Feedback>> feedbacks;
            feedbacks.reserve(change.feedbacks.size());
            for (const auto& feedback : change.feedbacks)
              feedbacks.push_back(std::const_pointer_cast<Feedback>(feedback));
            return feedbacks;
          },
          [](LawChange& change, const std::vector<std::shared_ptr<Feedback>>& feedbacks) {
            change.feedbacks.assign(feedbacks.begin(), feedbacks.end());
          });

  py::class_<Direction>(m, "Direction")
      .def(py::init<>())
      .def_readwrite("unrelaxed_modulus", &Direction::unrelaxed_modulus)
      .def_readwrite("log_relaxation_time", &Direction::log_relaxation_time)
      .def_readwrite("relaxed_stress", &Direction::relaxed_stress)
      .def_readwrite("log_load_bearing_area", &Direction::log_load_bearing_area)
      .def_readwrite("true_strain", &Direction::true_strain)
      .def_readwrite("strain_rate", &Direction::strain_rate)
      .def_readwrite("modal_weight", &Direction::modal_weight)
      .def_readwrite("log_relaxation_ratio", &Direction::log_relaxation_ratio)
      .def_readwrite("initial_modal_stress", &Direction::initial_modal_stress)
      .def_readwrite("extra_modulus", &Direction::extra_modulus)
      .def_readwrite("log_extra_time", &Direction::log_extra_time)
      .def_readwrite("feedback", &Direction::feedback)
      .def_readwrite("feedback_parameter", &Direction::feedback_parameter);
}
