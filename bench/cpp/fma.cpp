// Fused multiply-adds that wait for nothing: twelve chains of four doubles, more than two units of four
// cycles' latency can be busy with.

using Vector = double __attribute__((vector_size(32)));

extern "C" double fma_limit(long vectors) {
  constexpr int chains = 12;
  Vector sum[chains];
  for (int i = 0; i < chains; ++i) sum[i] = Vector{} + i;
  Vector factor = Vector{} + 0.999999, term = Vector{} + 1e-6;
  asm volatile("" : "+x"(factor), "+x"(term));  // not known to the compiler
  for (long done = 0; done < vectors; done += chains)
    for (int i = 0; i < chains; ++i) sum[i] = sum[i] * factor + term;
  Vector total{};
  for (int i = 0; i < chains; ++i) total += sum[i];
  return total[0] + total[1] + total[2] + total[3];
}
