// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_identity_modes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.identity_modes", &read_identity_modes, version{1},
     doc{"Reads the identity modes of an ICT-FaceKit folder (identityNNN.obj), for the rig that decode.rig reads "
         "there."},
     input{"folder", "An ICT-FaceKit folder"},
     param("unit", &ReadIdentityModesOptions::unit,
           {{"automatic", LengthUnit::automatic}, {"mm", LengthUnit::mm}, {"cm", LengthUnit::cm}, {"m", LengthUnit::m}},
           "Unit of the lengths in the files; automatic goes by the size of the head"),
     output("modes", "Offsets of the rig's vertices, in mm, at one standard deviation"));
