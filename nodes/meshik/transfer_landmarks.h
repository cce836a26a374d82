// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/key_shapes.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"
#include "nodes/types/vertex_targets.h"
#include "nodes/types/weights.h"

namespace face::meshik {

// Where the mesh's landmark vertices have to be in a frame: the key meshes' own, blended linearly by the frame's
// weights of the key shapes, and of that x and y alone (Animating Lip-Sync Speech Faces, section 6). Targets of
// meshik.solve. rig: whose mesh at rest the key meshes are poses of. key_shapes: whose landmarks are used. No weights
// (the frame was lost) give no targets.
// neutral: the speaker's landmarks at rest, in the order of the key shapes'. With them inner lips (points 61 to 63 of
// Multi-PIE above 67 to 65) that the key shapes show to be little apart are so, each lip going half of the way: lips of
// somebody who pouts are thicker than any weights of a rig make them, so that its mouth would open to reach their outer
// edge. Wide gaps are the key meshes' own: a tongue in them is taken for lip, which the outer edges correct.
// With them, too, the mouth is as wide as the key shapes show where a key mesh is more than about a millimetre off it,
// and all of the lips with it: what visemes say of how lips are rounded and spread is said of nobody in particular.
// frame: the speaker's landmarks in this frame, of a head that stands still (null = as the mixture; counts with neutral
// only). The mouth is wider or narrower by what the mixture leaves out of it.
// contact: how sure it is that the lips meet in this frame, 0 to 1 (null = 0; track.find_contact). Lips that meet may
// be thicker than at rest, which a mixture of key shapes takes for an opening: the pairs of Rig::inner_lips, which
// become targets too, go together by this share of the way. (The paper's lips, which nothing says that they meet, do
// not close on P, B and M.)
VertexTargets transfer_landmarks(const Rig& rig, const engine::Seq<Mesh>& key_meshes, const KeyShapes& key_shapes,
                                 const Weights& weights, const double* contact = nullptr,
                                 const Landmarks* neutral = nullptr, const Landmarks* frame = nullptr);

}  // namespace face::meshik
