# clang-tidy by the checks of .clang-tidy, over all sources as one file, and cppcheck: nothing to
# report. Each is skipped with a word where it is missing.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
execute_process(
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${WORK}/wireskin.h -P ${ROOT}/single_include/amalgamate.cmake
  COMMAND_ERROR_IS_FATAL ANY)

find_program(tidy NAMES clang-tidy clang-tidy-14)
if(tidy)
  execute_process(
    COMMAND ${tidy} --quiet --config-file=${ROOT}/.clang-tidy --header-filter=.*
            ${ROOT}/tests/embed/implementation.cpp
            -- -std=c++17 -fno-exceptions -fno-rtti -I${WORK}
    RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_QUIET)
  if(result EQUAL 0)
    message(STATUS "clang-tidy: passed")
  else()
    message(SEND_ERROR "clang-tidy:\n${text}")
  endif()
else()
  message(STATUS "clang-tidy: skipped, it is not here")
endif()

find_program(cppcheck NAMES cppcheck)
if(cppcheck)
  execute_process(
    COMMAND ${cppcheck} --std=c++17 --language=c++ --enable=warning,performance --quiet -j 2
            --suppress=missingIncludeSystem --error-exitcode=1 -I${ROOT}/src ${ROOT}/src
    RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(result EQUAL 0)
    message(STATUS "cppcheck: passed")
  else()
    message(SEND_ERROR "cppcheck:\n${text}")
  endif()
else()
  message(STATUS "cppcheck: skipped, it is not here")
endif()
