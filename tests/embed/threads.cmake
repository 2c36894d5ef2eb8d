# Two calls in two threads, and the bodies of one call in three, under ThreadSanitizer.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)
look_for(ThreadSanitizer clang++)
if(found)
  execute_process(
    COMMAND clang++ -std=c++17 -O0 -g1 -fsanitize=thread -pthread -I${WORK} -I${ROOT}/tests
            ${ROOT}/tests/embed/threads_main.cpp ${implementation} ${scene_sources}
            -o ${WORK}/threads
    COMMAND_ERROR_IS_FATAL ANY)
  set(ENV{TSAN_OPTIONS} halt_on_error=1)
  must(ThreadSanitizer ${WORK}/threads)
endif()
