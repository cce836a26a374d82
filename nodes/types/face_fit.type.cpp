// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/face_fit.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(FaceFit, "face_fit", codec_version{2}, doc{"What a morphable model says about the face in a picture."},
     field<&FaceFit::identity>(), field<&FaceFit::expression>(), field<&FaceFit::albedo>(),
     field<&FaceFit::camera>(field<&Camera::cam_from_world>(), field<&Camera::position_mm>(),
                             field<&Camera::focal_px>(), field<&Camera::centre_x_px>(), field<&Camera::centre_y_px>()),
     field<&FaceFit::image_width_px>(), field<&FaceFit::image_height_px>(),
     field<&FaceFit::light>(field<&FaceLight::ambient>(), field<&FaceLight::parallel>(), field<&FaceLight::direction>(),
                            field<&FaceLight::contrast>(), field<&FaceLight::gain>(), field<&FaceLight::offset>(),
                            field<&FaceLight::mirror>()),
     field<&FaceFit::converged>(), field<&FaceFit::problem>(), field<&FaceFit::landmark_rms_px>(),
     field<&FaceFit::landmark_nme>(), field<&FaceFit::image_rms>(), field<&FaceFit::lip_gap_mm>());
