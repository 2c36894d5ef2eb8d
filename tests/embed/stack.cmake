# The stack that the library needs at most: 48 KiB on the deepest path through it, callbacks apart, and
# no recursion. GRAPH is the call graph of the single header that gcc wrote at -O2, else one is made.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)
look_for(stack python3 g++)
if(found)
  if(NOT GRAPH)
    set(GRAPH ${WORK}/library.ci)
    execute_process(
      COMMAND g++ -std=c++17 -O2 -fno-exceptions -fno-rtti -fcallgraph-info=su -I${WORK}
              -c ${implementation} -o ${WORK}/library.o
      WORKING_DIRECTORY ${WORK} COMMAND_ERROR_IS_FATAL ANY)
  endif()
  execute_process(COMMAND python3 ${ROOT}/tests/embed/stack.py ${GRAPH} 49152
                  COMMAND_ERROR_IS_FATAL ANY)
endif()
