# The reference scenes under a tool that sees reads of memory that was never written: MemorySanitizer, or
# valgrind on a plain build, PROGRAM (which also sees every leak and every access out of bounds). The
# golden hashes are compared, so every byte of every result counts as read.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)
if(TOOL STREQUAL "valgrind")
  look_for(valgrind valgrind)
  if(found)
    must(valgrind valgrind --quiet --error-exitcode=9 --leak-check=full ${PROGRAM})
  endif()
else()
  # The C++ runtime of the system is not instrumented; with its templates instantiated here instead of
  # there, none of it that matters is left. Unoptimised, for clang takes five times as long else.
  look_for(MemorySanitizer clang++)
  if(found)
    execute_process(COMMAND clang++ -std=c++17 -O0 -g1 -ffp-contract=off -I${WORK} -I${ROOT}/tests
                            ${golden_sources} ${implementation} -fsanitize=memory
                            -D_GLIBCXX_EXTERN_TEMPLATE=0 -o ${WORK}/scenes
                    COMMAND_ERROR_IS_FATAL ANY)
    must(MemorySanitizer ${WORK}/scenes)
  endif()
endif()
