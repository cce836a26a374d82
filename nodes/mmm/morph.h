// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/flow_field.h"
#include "nodes/types/image.h"
#include "nodes/types/mmm.h"
#include "nodes/types/vec.h"

namespace face::mmm {

// Throws unless all prototypes have pictures and flows of one size and the reference is one of them.
void check_model(const Mmm& model);

// The robust flow from a mouth to another as the model has it: displacement of every pixel of the reference.
std::vector<Vec2f> follow_mouth(const Image& reference, const Image& image);

// sum_i alpha_i C_i, every pixel of the reference. alpha: N.
std::vector<Vec2f> mix_flows(const Mmm& model, const float* alpha);

// Where every pixel of a warped picture comes from in the reference: the solution x of x + flow(x) = pixel, by
// fixed-point steps that are halved where they do not help. Where a flow folds (lips that close) one of the sheets;
// where it tears (lips that part) what lies about the hole goes on into it.
std::vector<Vec2f> invert_flow(const std::vector<Vec2f>& flow, int width, int height);

// Prototype i brought to the shape whose inverse is given (Ezzat et al. 2002, section 4.4: W(I_i, W(C - C_i, C_i))),
// 3 numbers, 0 to 255, for the pixels of every stride-th row and column. What the paper does by two forward warps is
// one look-up here: a pixel that comes from x in the reference shows the prototype at x + C_i(x). It is the same
// picture, without the holes of forward warps and interpolated once.
std::vector<float> morph_prototype(const Mmm& model, std::size_t prototype, const std::vector<Vec2f>& inverse,
                                   int stride_px);

}  // namespace face::mmm
