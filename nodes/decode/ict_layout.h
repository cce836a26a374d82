// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>

namespace face::decode {

// Facts about the mesh of the ICT Face Model Light, which its files do not state.
// (Li et al., Learning Formation of Physically-Based Face Attributes, CVPR 2020; github.com/ICT-VGL/ICT-FaceKit, MIT.)
inline constexpr std::size_t ict_vertex_count = 26719;

struct VertexRange {
  std::uint32_t first, last;
  constexpr bool contains(std::uint32_t v) const { return first <= v && v <= last; }
};
// ICT-FaceKit README, "Vertex indices": geometry groups.
inline constexpr VertexRange ict_face = {0, 9408};
inline constexpr VertexRange ict_mouth_socket = {11248, 13293};
inline constexpr VertexRange ict_eye_sockets = {13294, 14061};
// Upper lashes: one of the three cards of each eye (measured: connected pieces of M_EyeLashes).
inline constexpr VertexRange ict_upper_lashes[] = {{25351, 25464}, {26035, 26148}};

// Multi-PIE 68 landmarks as vertices of the ICT mesh, 0-based (ICT-FaceKit README, "Multi-PIE 68 Facial Landmarks").
inline constexpr std::array<std::uint32_t, 68> ict_landmarks68 = {
    1225, 1888, 1052, 367,  1719, 1722, 2199, 1447, 966,  3661, 4390, 3927, 3924, 2608, 3272, 4088, 3443,
    268,  493,  1914, 2044, 1401, 3615, 4240, 4114, 2734, 2509, 978,  4527, 4942, 4857, 1140, 2075, 1147,
    4269, 3360, 1507, 1542, 1537, 1528, 1518, 1511, 3742, 3751, 3756, 3721, 3725, 3732, 5708, 5695, 2081,
    0,    4275, 6200, 6213, 6346, 6461, 5518, 5957, 5841, 5702, 5711, 5533, 6216, 6207, 6470, 5517, 5966};

}  // namespace face::decode
