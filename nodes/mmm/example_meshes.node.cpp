// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/example_meshes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.example_meshes", &example_meshes, version{2}, doc{"Example poses for MeshIK from a rig's own shapes."},
     input{"rig", "The head"}, param("shapes", &ExampleMeshesOptions::shapes, "Names of the shapes, one mesh each"),
     output("reference", "The head at rest"), output("examples", "The head in every pose"));
