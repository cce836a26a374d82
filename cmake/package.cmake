# SPDX-License-Identifier: Apache-2.0
# `cpack -G DEB` in the build folder makes facegraph_VERSION_amd64.deb: everything that is installed, in a folder of its own (libraries
# are called libengine.so and the like), with the command linked as /usr/bin/facegraph.
set(CPACK_PACKAGE_NAME facegraph)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Graphs of nodes for facial performance and speech animation")
set(CPACK_PACKAGE_CONTACT "Facegraph maintainers <facegraph@localhost>")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr/lib/facegraph)
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_DEPENDS pocketsphinx-en-us)
file(WRITE ${PROJECT_BINARY_DIR}/package/postinst "#!/bin/sh\nset -e\nln -sfn /usr/lib/facegraph/bin/facegraph /usr/bin/facegraph\n")
file(WRITE ${PROJECT_BINARY_DIR}/package/prerm
     "#!/bin/sh\nset -e\n[ \"$(readlink /usr/bin/facegraph)\" != /usr/lib/facegraph/bin/facegraph ] || rm -f /usr/bin/facegraph\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/package/postinst ${PROJECT_BINARY_DIR}/package/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# What is not installed need not be built for it.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
include(CPack)
