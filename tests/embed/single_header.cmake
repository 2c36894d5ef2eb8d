# The committed single header is the one that src gives.
cmake_minimum_required(VERSION 3.25)
file(MAKE_DIRECTORY ${WORK})
execute_process(
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${WORK}/wireskin.h -P ${ROOT}/single_include/amalgamate.cmake
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(
  COMMAND ${CMAKE_COMMAND} -E compare_files ${WORK}/wireskin.h ${ROOT}/single_include/wireskin.h
  RESULT_VARIABLE different)
if(different)
  message(FATAL_ERROR "single_include/wireskin.h is not what src gives; write it again with "
                      "`cmake --build build/test --target single_include`")
endif()
