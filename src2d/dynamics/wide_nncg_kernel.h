/// The passes of the conjugate gradient over all impulses: the same operations in the same order as
/// in nncg.h. Included by wide_kernels.cpp once for each set of instructions, after wide_kernel.h;
/// so it includes nothing, and has no `#pragma once`.

/// Four sums side by side, one per row of a block.
inline SweepChange changeWide(const ImpulseVectors& of) {
  Four squared{}, total{};
  for (std::size_t i = 0; i < of.size; ++i) {
    Four now, before;
    load(now, of.now[i].data());
    load(before, of.before[i].data());
    const Four change = now - before;
    squared += change * change;
    total += now * now;
  }
  return {(squared[0] + squared[1]) + (squared[2] + squared[3]),
          (total[0] + total[1]) + (total[2] + total[3])};
}

inline void stepWide(const ImpulseVectors& of, double rho, double keep) {
  for (std::size_t i = 0; i < of.size; ++i) {
    Four lambda, p, before;
    load(lambda, of.now[i].data());
    load(p, of.direction[i].data());
    load(before, of.before[i].data());
    const Four along = rho * p, next = lambda + along;
    store(of.direction[i].data(), along + keep * (lambda - before));
    store(of.now[i].data(), next);
    store(of.before[i].data(), next);
  }
}
