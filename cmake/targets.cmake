# SPDX-License-Identifier: Apache-2.0
# The four words of the project's CMake:
#   area(NAME [PLAIN] LINKS ...)  an algorithm library, its node adapters and its tests (tests/nodes/NAME/*_test.cpp);
#                                 PLAIN: without the value types of nodes/types
#   sources(NAME ...)             further algorithm files of the area (NAME.cpp)
#   node(NAME ...)                a node of the area: NAME.cpp (algorithm, unless in a file of sources()) and NAME.node.cpp
#   plugin(NAME AREAS ...)        one shared library that holds the nodes of these areas

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(FACEGRAPH_PLUGIN_DIR ${PROJECT_BINARY_DIR}/lib/facegraph/plugins)
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

# Flags every target shares. The instruction set is part of the plugin ABI tag; contraction off keeps results bit-equal.
add_library(facegraph_flags INTERFACE)
target_compile_options(facegraph_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # GCC 12 warns of its own std::string (GCC bug 105651)
  -march=x86-64-v3 -ffp-contract=off -ffile-prefix-map=${PROJECT_SOURCE_DIR}=.)
# Eigen asks the processor for its caches and sums in blocks of that size: not asked, it sums in one order everywhere.
target_compile_definitions(facegraph_flags INTERFACE EIGEN_DONT_PARALLELIZE EIGEN_NO_CPUID)
target_include_directories(facegraph_flags INTERFACE ${PROJECT_SOURCE_DIR})
if(FACEGRAPH_SANITIZE)
  target_compile_options(facegraph_flags INTERFACE -fsanitize=${FACEGRAPH_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(facegraph_flags INTERFACE -fsanitize=${FACEGRAPH_SANITIZE})
else()
  target_link_options(facegraph_flags INTERFACE -Wl,-z,defs)
endif()

# One test executable from every *_test.cpp in a folder of tests/.
function(test_suite name folder)
  file(GLOB tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${folder}/*_test.cpp)
  if(NOT FACEGRAPH_TESTS OR NOT tests)
    return()
  endif()
  add_executable(${name}_test ${tests})
  target_link_libraries(${name}_test PRIVATE facegraph_flags test_support GTest::gtest_main ${ARGN})
  set_target_properties(${name}_test PROPERTIES EXPORT_COMPILE_COMMANDS ON)
  gtest_discover_tests(${name}_test TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT 600 LABELS ${name})
endfunction()

function(area name)
  cmake_parse_arguments(arg "PLAIN" "" "LINKS" ${ARGN})
  if(NOT arg_PLAIN)
    list(APPEND arg_LINKS face_types)
  endif()
  add_library(face_${name} STATIC)
  set_target_properties(face_${name} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(face_${name} PUBLIC facegraph_flags ${arg_LINKS})
  add_library(face_${name}_nodes OBJECT)
  target_link_libraries(face_${name}_nodes PRIVATE face_${name} engine)
  set(AREA ${name} PARENT_SCOPE)
  test_suite(${name} nodes/${name} face_${name})
endfunction()

function(sources)
  foreach(name IN LISTS ARGN)
    target_sources(face_${AREA} PRIVATE ${name}.cpp)
  endforeach()
endfunction()

function(node)
  foreach(name IN LISTS ARGN)
    if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${name}.cpp)
      target_sources(face_${AREA} PRIVATE ${name}.cpp)
    endif()
    target_sources(face_${AREA}_nodes PRIVATE ${name}.node.cpp)
  endforeach()
endfunction()

# The build tree is laid out as the installed one (bin, lib, lib/facegraph/plugins), so that what is installed is what was
# built, bit for bit: a plugin's digest is in the keys of its results.
function(relocatable target run_path)
  set_target_properties(${target} PROPERTIES BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "${run_path}")
endfunction()

# Node objects are linked straight into the plugin: an archive would drop their registration.
function(plugin name)
  cmake_parse_arguments(arg "" "" "AREAS" ${ARGN})
  if(FACEGRAPH_PLUGINS_ONLY AND NOT name IN_LIST FACEGRAPH_PLUGINS_ONLY)
    return()
  endif()
  add_library(plugin_${name} MODULE ${PROJECT_SOURCE_DIR}/engine/plugin/plugin_entry.cpp)
  set_target_properties(plugin_${name} PROPERTIES PREFIX "" OUTPUT_NAME ${name}
    LIBRARY_OUTPUT_DIRECTORY ${FACEGRAPH_PLUGIN_DIR})
  relocatable(plugin_${name} "$ORIGIN/../..")
  target_link_libraries(plugin_${name} PRIVATE facegraph_flags engine)
  # The node list beside the library, so that listing loads nothing.
  add_custom_command(TARGET plugin_${name} POST_BUILD
    COMMAND facegraph_list_nodes $<TARGET_FILE:plugin_${name}> ${FACEGRAPH_PLUGIN_DIR}/${name}.nodes.json VERBATIM)
  add_dependencies(plugin_${name} facegraph_list_nodes)
  foreach(area IN LISTS arg_AREAS)
    target_sources(plugin_${name} PRIVATE $<TARGET_OBJECTS:face_${area}_nodes>)
    target_link_libraries(plugin_${name} PRIVATE face_${area})
  endforeach()
  # Graphs that are data of a plugin: nodes/AREA/commands/NAME.json is run by `facegraph NAME`, nodes/AREA/differences/SUFFIX.json
  # compares two files for `facegraph compare`, nodes/AREA/checks/SUFFIX.json looks at one for `facegraph doctor`.
  foreach(folder IN LISTS arg_AREAS)
    foreach(kind checks commands differences)
      file(GLOB graphs CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/nodes/${folder}/${kind}/*.json)
      foreach(graph IN LISTS graphs)
        get_filename_component(file ${graph} NAME)
        add_custom_command(OUTPUT ${FACEGRAPH_PLUGIN_DIR}/${kind}/${file}
          COMMAND ${CMAKE_COMMAND} -E copy ${graph} ${FACEGRAPH_PLUGIN_DIR}/${kind}/${file} DEPENDS ${graph} VERBATIM)
        target_sources(plugin_${name} PRIVATE ${FACEGRAPH_PLUGIN_DIR}/${kind}/${file})
        install(FILES ${graph} DESTINATION lib/facegraph/plugins/${kind})
      endforeach()
    endforeach()
  endforeach()
  # The list after the library, so that it is not the older one.
  install(TARGETS plugin_${name} LIBRARY DESTINATION lib/facegraph/plugins)
  install(FILES ${FACEGRAPH_PLUGIN_DIR}/${name}.nodes.json DESTINATION lib/facegraph/plugins)
endfunction()
