# SPDX-License-Identifier: Apache-2.0
# Every library the project uses, found once, as imported (SYSTEM) targets. All are Debian 12 packages (see tools/packages.txt).
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(ZLIB REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Boost REQUIRED COMPONENTS filesystem)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(OpenMesh REQUIRED)
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs video)
find_package(meshoptimizer REQUIRED)
pkg_check_modules(draco REQUIRED IMPORTED_TARGET draco)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(sndfile REQUIRED IMPORTED_TARGET sndfile)
pkg_check_modules(pocketsphinx REQUIRED IMPORTED_TARGET pocketsphinx)
pkg_check_modules(libav REQUIRED IMPORTED_TARGET libavformat libavcodec libavutil libswscale libswresample)

# tinygltf and CLI11 are header-only. flite has no pkg-config file. CHOLMOD is simplicial only, for bit-equal results.
find_path(TINYGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)
add_library(tinygltf_headers INTERFACE IMPORTED)
target_include_directories(tinygltf_headers SYSTEM INTERFACE ${TINYGLTF_INCLUDE_DIR})

add_library(flite INTERFACE IMPORTED)
target_link_libraries(flite INTERFACE flite_cmu_us_slt flite_cmu_us_rms flite_cmu_us_awb flite_cmu_us_kal
                                      flite_usenglish flite_cmulex ${CMAKE_DL_LIBS} m)
find_library(FLITE_LIBRARY flite REQUIRED)
target_link_libraries(flite INTERFACE ${FLITE_LIBRARY})

# OpenCV as one imported target that brings its headers as SYSTEM.
add_library(opencv INTERFACE IMPORTED)
target_include_directories(opencv SYSTEM INTERFACE ${OpenCV_INCLUDE_DIRS})
target_link_libraries(opencv INTERFACE ${OpenCV_LIBS})
# Its contributed flows (TV-L1), for who compares with them; the same Debian package.
add_library(opencv_optflow_only INTERFACE IMPORTED)
find_library(OPENCV_OPTFLOW_LIBRARY opencv_optflow REQUIRED)
target_link_libraries(opencv_optflow_only INTERFACE ${OPENCV_OPTFLOW_LIBRARY})

if(FACEGRAPH_TESTS)
  find_package(GTest REQUIRED)
  enable_testing()
  include(GoogleTest)
  add_library(test_support INTERFACE)
  target_compile_definitions(test_support INTERFACE FACEGRAPH_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    FACEGRAPH_PLUGIN_DIR="${PROJECT_BINARY_DIR}/lib/facegraph/plugins"
    FACEGRAPH_COMMAND="${PROJECT_BINARY_DIR}/bin/facegraph")
endif()
if(FACEGRAPH_BENCH)
  find_package(benchmark REQUIRED)
endif()
