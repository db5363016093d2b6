#pragma once
/// A recording as a page carries it: a JSON head that says what there is, and packed columns.
/// lessons/web/src/head.ts and tracks.ts read it again; they change together.

#include <string>
#include <vector>

#include "lessons/recording.h"

namespace merge2d {

/// How fine. The first of `encodings()` that makes a page small enough is taken.
struct Encoding {
  double positions = 65536.0;  ///< steps per visible height
  double decades = 256.0;      ///< steps per factor of two of a velocity or an impulse
  int contacts_every = 1;      ///< time steps between two samples of contacts and decisions
  std::size_t impulses = 0;    ///< how many contacts' impulses inside steps, over all steps
};
const std::vector<Encoding>& encodings();

struct EncodedTrace {
  std::string head;  ///< a JSON object
  std::string data;  ///< base64 of zlib
};

EncodedTrace encode(const Recording& recording, const Encoding& encoding);

/// The camera of a recording: the scene's, or one that fits the area that its bodies cover.
Camera cameraOf(const Recording& recording);

}  // namespace merge2d
