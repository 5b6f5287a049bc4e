# baraka_add_controller(<name> SOURCES <file>... [OUTPUT_DIRECTORY <folder>])
#
# Makes two things of the same sources, which define one BARAKA_CONTROLLER:
#   <name>      the program, which drives agents of a simulator or a real robot over DDS
#   <name>.so   the plug-in, which `baraka check` asks for its parameters and `baraka run
#               --controllers in-process` runs
# Both go to OUTPUT_DIRECTORY, by default the current build folder. A library of the sources is
# `controller_<name>`: link to it what they need, and tests of them.
function(baraka_add_controller name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "OUTPUT_DIRECTORY" "SOURCES")
  if(NOT ARG_SOURCES)
    message(FATAL_ERROR "baraka_add_controller(${name}): SOURCES are missing")
  endif()
  if(NOT ARG_OUTPUT_DIRECTORY)
    set(ARG_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  add_library(controller_${name} OBJECT ${ARG_SOURCES})
  target_link_libraries(controller_${name} PUBLIC baraka::controller)
  set_target_properties(controller_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  add_executable(${name})
  target_link_libraries(${name} PRIVATE controller_${name} baraka::controller_main)
  add_library(${name}_plugin MODULE)
  target_link_libraries(${name}_plugin PRIVATE controller_${name})
  set_target_properties(${name}_plugin PROPERTIES PREFIX "" OUTPUT_NAME ${name})
  set_target_properties(${name} ${name}_plugin PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${ARG_OUTPUT_DIRECTORY}
    LIBRARY_OUTPUT_DIRECTORY ${ARG_OUTPUT_DIRECTORY})
endfunction()
