// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

namespace face::mmm {

// Pictures that are mixed: values of height x width x 3, each with its share.
struct MixedPicture {
  std::vector<float> values;
  double share = 0;
  double energy = 0;  // of its detail in all, before it was brought to another shape (detail_energy); 0 = as it is
};

// Sum of squares of what a binomial of 5 x 5 takes away from the brightness of a picture.
double detail_energy(const std::vector<float>& values, int width, int height);

// Gives a mean of pictures the contrast in small things that these have. Things that lie not quite upon each other, the
// edge of a lip or the lines in it, are weaker in a mean than in each of the pictures: there the mean's detail (what a
// binomial of 5 x 5 takes away) is made stronger, until its energy about a pixel is the mean of theirs, at most `most`
// times (Heitz and Neyret, High-Performance By-Example Noise using a Histogram-Preserving Blending Operator, 2018: the
// variance of what is blended is kept). Differs from the source: per place and in detail alone; and the part of their
// energy that is noise of noise_level grey levels (standard deviation), and was lost, is not asked for: add_grain
// draws it anew.
// mixed: the mean, changed in place. shares: not negative; they add up to about 1.
void keep_detail(std::vector<float>& mixed, const std::vector<MixedPicture>& pictures, int width, int height,
                 double noise_level, double most);

}  // namespace face::mmm
