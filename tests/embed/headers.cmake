# Both headers are C89; the implementation compiles as C++17 without a warning, gives the includer
# back its macros and says so where the language is older. TIER=quick leaves the implementation to
# the tests that are built with it, TIER=full turns every warning on.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)
include(${ROOT}/tests/embed/find_compilers.cmake)
set(here ${ROOT}/tests/embed)

function(compiles)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result ERROR_VARIABLE error)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(SEND_ERROR "${command}\n${error}")
  endif()
endfunction()

foreach(cxx IN LISTS compilers)
  set(c ${c_of_${cxx}})
  set(warnings -Wall -Wextra -Wpedantic -Werror -fsyntax-only)
  foreach(include ${ROOT}/src ${WORK})
    compiles(${c} -std=c89 -pedantic-errors ${warnings} -I${include} ${here}/c89_user.c)
    compiles(${c} -std=c11 -DWIRESKIN_USER ${warnings} -I${include} ${here}/c89_user.c)
  endforeach()
  if(TIER STREQUAL "full")
    compiles(${cxx} -std=c++17 ${warnings} -Wconversion -Wshadow -I${WORK} ${here}/macro_user.cpp)
    compiles(${cxx} -std=c++20 ${warnings} -I${WORK} ${here}/macro_user.cpp)
  endif()

  execute_process(COMMAND ${cxx} -std=c++14 -fsyntax-only -Wfatal-errors -I${WORK} ${here}/macro_user.cpp
                  RESULT_VARIABLE result ERROR_VARIABLE error)
  if(result EQUAL 0 OR NOT error MATCHES "the implementation of wireskin is C\\+\\+17")
    message(SEND_ERROR "${cxx} -std=c++14 does not say that C++17 is needed")
  endif()
endforeach()
