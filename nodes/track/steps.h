// SPDX-License-Identifier: Apache-2.0
// The steps by which track_klt finds the points of a frame.
#pragma once
#include <complex>
#include <cstddef>
#include <string>
#include <vector>

#include "nodes/track/flow_pair.h"
#include "nodes/track/outline.h"
#include "nodes/track/patch.h"
#include "nodes/track/settle.h"
#include "nodes/track/shrink.h"
#include "nodes/track/track_klt.h"

namespace face::track {

// The patches of N points side by side, `row` 0 of those that the start placed, 1 of those that corrections did.
Image empty_patches(std::size_t count, int side_px);
std::vector<float> patch_of(const Image& patches, std::size_t index, int row, int side_px);
// The middle of it that tells the point's place (telling_side_px); side_px is of the patch that is kept.
int side_of(const Image& patches, std::size_t index, int row, int side_px);
void keep_patch(const Grey& grey, double x_px, double y_px, std::size_t index, int row, int side_px, Image& patches);

// What is known of the points before a frame is looked at.
struct Knowledge {
  Knowledge(const Landmarks& start_points, const TrackKltOptions& given);
  const Landmarks& start;
  const TrackKltOptions& options;
  int side_px;                        // of the patches that are kept
  std::vector<int> sides_px;          // of the part of its patch that a point is followed with
  std::vector<std::size_t> outline;   // indices; empty = no lips are sought
  std::vector<std::size_t> jaw_line;  // the same; empty without an outline
  double mouth_px = 0;                // its width at the start
  double eyes_px = 0;                 // distance of the inner corners of the eyes at the start; 0 without them
  Bonds bonds;
  // Sets sides_px by the patches that the start placed.
  void learn_sides(const Image& patches);
  // Something small that tells its place: a dot, a mole, a corner.
  bool is_mark(std::size_t point) const { return sides_px[point] < side_px; }
  // Where a head in this pose has the point; of bonds.depths_px.
  std::complex<double> on_head(const SolidHead& head, std::size_t point) const;
  // Such a point on a face whose lips are painted with dots, most of them at least.
  bool is_dot(std::size_t point) const;
};

// Likeness from which on a point's own patch is seen again. A dot painted on the face is told from skin also where it
// is stretched, seen from the side or in a shade.
double seen_again_from(const TrackKltOptions& options, bool is_dot);

// How far a point goes to its own patch, 0 to 1.
double anchor_share(const TrackKltOptions& options, bool is_dot, double likeness);

// Where the points of a frame were seen; entries by point.
struct Seen {
  std::vector<Sighting> sightings;
  std::vector<double> likeness;  // 0 to 1, to what was placed; 0 where nothing was seen
  double return_error_px = 0;    // largest there-and-back error of those that were followed
  double head_likeness = 0;      // of known.bonds.head, where that is known
};

// The part of a point's first patch that it is looked for with.
std::vector<float> own_patch(const Knowledge& known, const Image& patches, std::size_t index);

// Where points may be before they are followed.
struct Leap {
  std::vector<Sighting> places;
  std::vector<bool> found;  // dots that are seen there, together with others: no neighbour may doubt them
};

// Where dots painted on the lower lip and the jaw may be, which in speech go farther from one frame to the next than
// they are apart, and are alike: as far along the fall of the jaw (mouth_shape.h) as most of them are seen. places: in
// the previous frame; those of other points, and all where nothing is gained, stay.
Leap leap(const Knowledge& known, const Grey& now, const Image& patches, std::vector<Sighting> places);

// Where the points go with the head as it moves from one pose to the other.
std::vector<Sighting> go_along(const Knowledge& known, const SolidHead& before, const SolidHead& now,
                               std::vector<Sighting> places);

// Takes the valid points of the previous frame to this one. leapt: where they may be. Points that do not come home
// when they are followed back, or that leave their neighbours, are not seen.
Seen follow(const Knowledge& known, const FlowPair& flow, const Grey& before, const std::vector<Landmark>& points,
            const Leap& leapt);

// Moves points onto their own patches where these are seen again near them. Fades in, so that a patch that comes and
// goes does not make the point jump. Rigid points of which the patch is not seen are where the head has them, or
// forgotten where the head is not known.
void anchor(const Knowledge& known, const Grey& now, const Image& patches, Seen& seen);

// Looks for the points that were not seen by their own patches, about where the others say that they are.
void recover(const Knowledge& known, const Grey& now, const Image& patches, double search_px, Seen& seen);

// Looks for the whole face anywhere in the frame. Nothing is seen where it is not there.
Seen find_again(const Knowledge& known, const Grey& now, const Image& face, const Image& patches);

// A picture in which the edge of the lips is sought, by what it looked like in such a picture at the start.
struct LipPicture {
  const Image& image;
  Shrink shrink;  // of the frame
  const Matrix& look;

  EdgeSight see(const Knowledge& known, const std::vector<Sighting>& expected, const std::vector<Sighting>& rest) const;
};

// What a wide mouth is looked for in first: a smaller picture, in which the reach of an edge is a larger part of the
// mouth. The frame itself where the mouth is not wider than it is tracked best.
Shrink coarse_shrink(const Knowledge& known, const Image& frame);

// Brings the points of the outline to the edge of the lips, those of the jaw line to the contour of the chin, and all
// points to where their bonds let them be. lips: pictures of the frame, the smallest first. now: the frame. jaw_look:
// what that contour looks like.
void fit_contours(const Knowledge& known, const std::vector<LipPicture>& lips, const Grey& now, const Matrix& jaw_look,
                  Seen& seen);

// Follows one point that a correction placed, near where the other points of the frame let it be. layout: of all
// points. others: the points of this frame. Returns false where it is lost.
bool follow_corrected(const Knowledge& known, const FlowPair& flow, const Grey& before, const Grey& now,
                      const Landmarks& layout, const Landmarks& others, const Image& patches, std::size_t index,
                      Landmark& point);

}  // namespace face::track
