// SPDX-License-Identifier: Apache-2.0
// The one place of this area that compiles tinygltf (header-only). Pictures are not decoded by it.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
