#include "src2d/proofs/proof_gram.h"

#include <utility>

#include "src2d/proofs/load_product.h"

namespace merge2d {

void fillGram(LoadCertificate& proof) {
  const std::size_t n = proof.witnesses.size();
  proof.gram.resize(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      proof.gram[i * n + j] = proof.gram[j * n + i] =
          product(proof.witnesses[i], proof.witnesses[j]);
    }
  }
}

void dropFromGram(LoadCertificate& proof, std::size_t which) {
  const std::size_t n = proof.witnesses.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (i != which && j != which) proof.gram[kept++] = proof.gram[i * n + j];
    }
  }
  proof.gram.resize(kept);
}

void addToGram(LoadCertificate& proof) {
  const std::size_t n = proof.witnesses.size();
  const Witness& latest = proof.witnesses.back();
  std::vector<double> gram(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j + 1 < n; ++j) {
      if (i + 1 < n) gram[i * n + j] = proof.gram[i * (n - 1) + j];
    }
    gram[i * n + n - 1] = gram[(n - 1) * n + i] = product(proof.witnesses[i], latest);
  }
  proof.gram = std::move(gram);
}

}  // namespace merge2d
