# clang-tidy by the checks of .clang-tidy, over all sources as one file, and cppcheck: nothing to
# report. Each is skipped with a word where it is missing.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)

if(TOOL STREQUAL "clang-tidy")
  look_for(clang-tidy clang-tidy)
  if(found)
    must(clang-tidy clang-tidy --quiet --config-file=${ROOT}/.clang-tidy --header-filter=.*
         ${implementation} -- -std=c++17 -fno-exceptions -fno-rtti -I${WORK})
  endif()
else()
  # With -D one configuration is looked at; every further one would cost the same again.
  look_for(cppcheck cppcheck)
  if(found)
    must(cppcheck cppcheck --std=c++17 --language=c++ --enable=warning,performance --quiet
         -D__x86_64__ -D__SSE2__ -DWIRESKIN_DEBUG --suppress=missingIncludeSystem
         --error-exitcode=1 -I${ROOT}/src ${ROOT}/src)
  endif()
endif()
