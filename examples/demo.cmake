# cmake -DCOMMAND=... -DDATA=... -DOUT=... -P demo.cmake
# Surfaces every network in DATA (*.net, *.obj) with the wireskin command; leaves NAME.obj (surface),
# NAME.png (picture), NAME.html (page) and NAME.json (report) in OUT.
cmake_minimum_required(VERSION 3.25)
foreach(name COMMAND DATA OUT)
  if(NOT DEFINED ${name})
    message(FATAL_ERROR "demo.cmake needs -D${name}=...")
  endif()
endforeach()

file(GLOB networks LIST_DIRECTORIES false ${DATA}/*.net ${DATA}/*.obj)
list(SORT networks)
if(NOT networks)
  message(FATAL_ERROR "there is no network in ${DATA}")
endif()
file(MAKE_DIRECTORY ${OUT})

set(failed 0)
foreach(network IN LISTS networks)
  get_filename_component(name ${network} NAME_WE)
  set(up z)
  if(name STREQUAL "spot")
    set(up y)  # the model's own convention
  endif()
  execute_process(
    COMMAND ${COMMAND} ${network} -o ${OUT}/${name}.obj --image ${OUT}/${name}.png
            --html ${OUT}/${name}.html --report ${OUT}/${name}.json --up ${up}
    RESULT_VARIABLE result)
  if(result EQUAL 0)
    file(READ ${OUT}/${name}.json report)
    string(JSON vertices ERROR_VARIABLE ignored GET "${report}" vertices)
    string(JSON patches ERROR_VARIABLE ignored GET "${report}" patches)
    string(JSON total ERROR_VARIABLE ignored GET "${report}" total_ms)
    message(STATUS "${name}: ${patches} patches, ${vertices} vertices, ${total} ms")
  else()
    message(STATUS "${name}: the command failed (${result})")
    math(EXPR failed "${failed} + 1")
  endif()
endforeach()

message(STATUS "Surfaces (.obj), pictures (.png), pages (.html) and reports (.json) are in ${OUT}")
if(failed GREATER 0)
  message(FATAL_ERROR "${failed} networks could not be surfaced")
endif()
