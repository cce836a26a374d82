// SPDX-License-Identifier: Apache-2.0
// Nodes that put the engine under strain: failing, slow, large, streamed.
#pragma once
#include <string>

#include "engine/port.h"

namespace toy {

struct FailOptions {
  std::string when = "bad";
};
// The text, unless it contains `when`: then an error.
std::string fail(const std::string& text, const FailOptions& options);

struct SleepOptions {
  double seconds = 0.1;
};
// The text, after a while.
std::string sleep(const std::string& text, const SleepOptions& options, engine::Progress& progress);

struct CountUpOptions {
  int count = 10;
};
// The numbers 0, 1, 2, ..., one by one; the node is cheap.
void count_up(engine::SeqWriter<double>& numbers, const CountUpOptions& options);

struct BlobOptions {
  double size_mb = 10;
};
// A large text that depends on the number.
std::string blob(const double& number, const BlobOptions& options);

struct BlobFilmOptions {
  int count = 10;
  double size_mb = 10;
  double seconds = 0;
};
// Blobs of the numbers 0, 1, 2, ..., one by one and each after a while, as a film has frames; the node is cheap.
void blob_film(engine::SeqWriter<std::string>& blobs, const BlobFilmOptions& options);

// A blob with a number in place of its first bytes; the node is cheap.
std::string mark(const std::string& blob, const double& number);

struct BlobSizeOptions {
  double seconds = 0;
};
// Its size, after a while.
double blob_size(const std::string& blob, const BlobSizeOptions& options);

// The size of all; each takes a while.
double total_size(const engine::Seq<std::string>& blobs, const BlobSizeOptions& options);

}  // namespace toy
