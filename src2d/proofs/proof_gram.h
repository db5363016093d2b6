#pragma once
/// The products of the loads of all witnesses (LoadCertificate::gram).

#include "src2d/dynamics/collections.h"

namespace merge2d {

/// All of them anew.
void fillGram(LoadCertificate& proof);

/// Before a witness leaves.
void dropFromGram(LoadCertificate& proof, std::size_t which);

/// After another one has come, which is the last.
void addToGram(LoadCertificate& proof);

}  // namespace merge2d
