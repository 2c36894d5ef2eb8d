# The stack that the library needs at most: 48 KiB on the deepest path through it, callbacks apart, and
# no recursion.
cmake_minimum_required(VERSION 3.25)
find_program(python NAMES python3)
find_program(gxx NAMES g++)
if(NOT python OR NOT gxx)
  message(STATUS "skipped: this needs python3 and g++")
  return()
endif()
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
execute_process(
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${WORK}/wireskin.h -P ${ROOT}/single_include/amalgamate.cmake
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(
  COMMAND ${gxx} -std=c++17 -O2 -fno-exceptions -fno-rtti -fcallgraph-info=su -I${WORK}
          -c ${ROOT}/tests/embed/implementation.cpp -o ${WORK}/library.o
  WORKING_DIRECTORY ${WORK} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${python} ${ROOT}/tests/embed/stack.py ${WORK}/library.ci 49152
                COMMAND_ERROR_IS_FATAL ANY)
