# The committed single header is the one that src gives.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)
execute_process(
  COMMAND ${CMAKE_COMMAND} -E compare_files ${WORK}/wireskin.h ${ROOT}/single_include/wireskin.h
  RESULT_VARIABLE different)
if(different)
  message(FATAL_ERROR "single_include/wireskin.h is not what src gives; write it again with "
                      "`cmake --build build/test --target single_include`")
endif()
