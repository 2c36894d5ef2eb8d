# Two calls in two threads, and the bodies of one call in three, under ThreadSanitizer.
cmake_minimum_required(VERSION 3.25)
find_program(clang NAMES clang++ clang++-14)
if(NOT clang)
  message(STATUS "skipped: this needs clang++")
  return()
endif()
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
execute_process(
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${WORK}/wireskin.h -P ${ROOT}/single_include/amalgamate.cmake
  COMMAND_ERROR_IS_FATAL ANY)
file(GLOB sources ${ROOT}/tests/support/*scenes.cpp)
execute_process(
  COMMAND ${clang} -std=c++17 -O1 -g1 -fsanitize=thread -pthread -I${WORK} -I${ROOT}/tests
          ${ROOT}/tests/embed/threads_main.cpp ${ROOT}/tests/embed/implementation.cpp ${sources}
          -o ${WORK}/threads
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E env TSAN_OPTIONS=halt_on_error=1 ${WORK}/threads
                COMMAND_ERROR_IS_FATAL ANY)
