# Runs the example of one LANGUAGE on a sphere and checks its mesh.

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGN}\n${out}${err}")
  endif()
endfunction()

function(count_lines file letter variable)
  file(STRINGS ${file} lines REGEX "^${letter} ")
  list(LENGTH lines length)
  set(${variable} ${length} PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
set(net ${ROOT}/examples/data/sphere.net)
run(${REFERENCE} ${net} ${WORK}/reference.obj)

if(LANGUAGE STREQUAL "cpp")
  count_lines(${WORK}/reference.obj v vertices)
  count_lines(${WORK}/reference.obj f triangles)
  # Euler: a closed surface of genus 0.
  math(EXPR expected "2 * ${vertices} - 4")
  if(vertices LESS 1000 OR NOT triangles EQUAL expected)
    message(FATAL_ERROR "${vertices} vertices, ${triangles} triangles: that is no sphere")
  endif()
  return()
endif()

if(LANGUAGE STREQUAL "python")
  if(NOT PYTHON)
    message("skipped: no python3")
    return()
  endif()
  run(${PYTHON} ${ROOT}/examples/python/surface_net.py ${SHARED_LIBRARY} ${net} ${WORK}/out.obj)
elseif(LANGUAGE STREQUAL "rust")
  if(NOT RUSTC)
    message("skipped: no rustc")
    return()
  endif()
  get_filename_component(folder ${STATIC_LIBRARY} DIRECTORY)
  run(${RUSTC} --edition 2021 -O -D warnings ${ROOT}/examples/rust/surface_net.rs
      -o ${WORK}/surface_net -L ${folder} -l static=wireskin -l m)
  run(${WORK}/surface_net ${net} ${WORK}/out.obj)
elseif(LANGUAGE STREQUAL "javascript")
  if(NOT NODE OR NOT CC OR NOT EXISTS "${WASM_OBJECT}")
    message("skipped: node or clang-14 is not here, or golden/cross/wasm has built no object")
    return()
  endif()
  # As the example says, but for the object, which golden/cross/wasm made with the same flags.
  run(${CC} --target=wasm32-wasi -mexec-model=reactor ${WASM_OBJECT} -lm -o ${WORK}/wireskin.wasm
      -Wl,--export=malloc,--export=free,--export=wsk_build,--export=wsk_status_name
      -Wl,--export=wsk_surface_get_view,--export=wsk_surface_free)
  run(${NODE} ${ROOT}/examples/javascript/surface_net.mjs ${WORK}/wireskin.wasm ${net}
      ${WORK}/out.obj)
endif()

# Each language prints numbers in its own way, but the mesh is the same: as many lines of each kind,
# and the same triangles.
count_lines(${WORK}/reference.obj v expected)
count_lines(${WORK}/out.obj v vertices)
file(STRINGS ${WORK}/reference.obj expected_triangles REGEX "^f ")
file(STRINGS ${WORK}/out.obj triangles REGEX "^f ")
if(NOT vertices EQUAL expected OR NOT triangles STREQUAL expected_triangles)
  message(FATAL_ERROR "the mesh is not that of the example in C++")
endif()
