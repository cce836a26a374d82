# SPDX-License-Identifier: Apache-2.0
# What `cmake --install BUILD --prefix PREFIX` installs: the command with its libraries, plugins and graphs, and what somebody
# needs to build a plugin (docs/writing-a-plugin.md). Plugins are installed by plugin().
include(CMakePackageConfigHelpers)
relocatable(face_types "$ORIGIN")
install(TARGETS facegraph facegraph_list_nodes engine face_types RUNTIME DESTINATION bin LIBRARY DESTINATION lib)

# engine/node.h, engine/port.h, and what these include. plugin_entry.cpp is compiled into every plugin.
set(include_folder include/facegraph)
install(FILES ${PROJECT_SOURCE_DIR}/engine/node.h ${PROJECT_SOURCE_DIR}/engine/port.h
        DESTINATION ${include_folder}/engine)
foreach(folder engine/base engine/value engine/declare nodes/types)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}/ DESTINATION ${include_folder}/${folder}
          FILES_MATCHING PATTERN "*.h")
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/engine/plugin/descriptor.h ${PROJECT_SOURCE_DIR}/engine/plugin/plugin_entry.cpp
        DESTINATION ${include_folder}/engine/plugin)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/graphs DESTINATION share/facegraph PATTERN broken EXCLUDE)

string(REGEX MATCH "^[0-9]+" FACEGRAPH_COMPILER_MAJOR "${CMAKE_CXX_COMPILER_VERSION}")
set(engine_library lib/libengine.so)
set(types_library lib/libface_types.so)
set(list_nodes bin/facegraph_list_nodes)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/FacegraphConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/FacegraphConfig.cmake INSTALL_DESTINATION lib/cmake/Facegraph
  PATH_VARS include_folder engine_library types_library list_nodes)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/FacegraphConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/FacegraphConfig.cmake
              ${PROJECT_BINARY_DIR}/package/FacegraphConfigVersion.cmake DESTINATION lib/cmake/Facegraph)
