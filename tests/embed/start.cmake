# How the scripts of tests/embed and tests/golden begin: an empty folder WORK with the single header that
# src gives, and what they need to say which tool is missing and which step failed.
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
execute_process(
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${WORK}/wireskin.h -P ${ROOT}/single_include/amalgamate.cmake
  COMMAND_ERROR_IS_FATAL ANY)
set(implementation ${ROOT}/tests/embed/implementation.cpp)
file(GLOB scene_sources ${ROOT}/tests/support/*scenes.cpp)
set(golden_sources ${ROOT}/tests/golden/golden_print.cpp ${scene_sources})

# look_for(NAME program ...): sets `found` where all programs are here, else says what is missing, and
# the path of each as <program>_path.
function(look_for name)
  set(found TRUE PARENT_SCOPE)
  foreach(program IN LISTS ARGN)
    set(path path-NOTFOUND)
    find_program(path ${program} NO_CACHE PATHS /usr/lib/wine)
    if(NOT path)
      message(STATUS "${name}: skipped, ${program} is not here")
      set(found FALSE PARENT_SCOPE)
      return()
    endif()
    set(${program}_path ${path} PARENT_SCOPE)
  endforeach()
endfunction()

# must(NAME command ...): `passed` where the command succeeds, else all that it said.
function(must name)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(result EQUAL 0)
    message(STATUS "${name}: passed")
  else()
    message(SEND_ERROR "${name}: result ${result}\n${text}")
  endif()
endfunction()
