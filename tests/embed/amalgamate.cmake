# The amalgamator refuses what would break the single header, and keeps what CMake could garble.
cmake_minimum_required(VERSION 3.25)

function(amalgamate name)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${WORK}/${name} -DOUTPUT=${WORK}/${name}.h
            -P ${ROOT}/single_include/amalgamate.cmake
    RESULT_VARIABLE result ERROR_VARIABLE error OUTPUT_VARIABLE ignored)
  string(REGEX REPLACE "[ \n]+" " " error "${error}")
  set(result "${result}" PARENT_SCOPE)
  set(error "${error}" PARENT_SCOPE)
endfunction()

# refuses(NAME "what the sentence must say" FILE CONTENT ...); `$` stands for a semicolon
function(refuses name expected)
  file(REMOVE_RECURSE ${WORK}/${name})
  file(WRITE ${WORK}/${name}/wireskin.h "int wsk\;\n")
  while(ARGN)
    list(POP_FRONT ARGN file content)
    string(REPLACE "$" ";" content "${content}")
    file(WRITE ${WORK}/${name}/${file} "${content}")
  endwhile()
  amalgamate(${name})
  if(result EQUAL 0)
    message(SEND_ERROR "${name}: accepted")
  elseif(NOT error MATCHES "${expected}")
    message(SEND_ERROR "${name}: expected \"${expected}\", got: ${error}")
  endif()
endfunction()

refuses(cycle "in a circle: .*a.h -> b.h -> a.h"
        a.cpp "#include \"a.h\"\n" a.h "#include \"b.h\"\n" b.h "#include \"a.h\"\n")
refuses(unused "src/b.h is included by no source" a.cpp "\n" b.h "\n")
refuses(foreign "src/notes.txt is neither" a.cpp "\n" notes.txt "\n")
refuses(missing "includes \"b.h\", which src does not have" a.cpp "#include \"b.h\"\n")
refuses(conditional "includes \"b.h\" under a condition"
        a.cpp "#ifdef X\n#include \"b.h\"\n#endif\n" b.h "\n")
refuses(comment "slash and a star" a.cpp "// all of src/*.cpp\n")
refuses(digits "write 1'000 without" a.cpp "int k = 1'000$\n")
refuses(slashes "a string with two slashes" a.cpp "const char* k = \"a//b\"$\n")
refuses(function "wireskin::x::help is defined in src/a.cpp and in src/b.cpp"
        a.cpp "namespace wireskin::x {\nstatic int help(int a) {}\n}  // namespace wireskin::x\n"
        b.cpp "namespace wireskin::x {\nstatic void\nhelp(int b,\n int c) {}\n}  // namespace wireskin::x\n")
refuses(array "wireskin::k_table is defined"
        a.cpp "namespace wireskin {\nstatic const double k_table[2] = {1, 2}$\n}  // namespace\n"
        b.cpp "namespace wireskin {\nnamespace {\nconstexpr int k_table = 3$\n}  // namespace\n}  // namespace\n")
refuses(type "wireskin::Shape is defined"
        a.cpp "namespace wireskin {\nstruct Shape {\n}$\n}  // namespace wireskin\n"
        b.cpp "namespace wireskin {\nclass [[nodiscard]] Shape : Base {\n}$\n}  // namespace wireskin\n")
refuses(macro "the macro LOCAL is defined" a.cpp "#define LOCAL 1\n" b.cpp "#define LOCAL 2\n")

# The same names in different namespaces, overloads in one file and declarations are fine, and every
# character comes through.
set(name accepts)
file(REMOVE_RECURSE ${WORK}/${name})
file(WRITE ${WORK}/${name}/wireskin.h "int wsk[2];\n")
file(WRITE ${WORK}/${name}/a/a.h "#pragma once\n#include <cstddef>\nnamespace wireskin { struct Later; }\n")
set(body "namespace wireskin::a {\nstatic int f(int x) { return \"a;b\\\\[\"[x] + '\\\\'; }\nstatic int f() { return k[f(1)]; }\n}  // namespace wireskin::a")
file(WRITE ${WORK}/${name}/a/a.cpp "#include \"a/a.h\"\n\n${body}\n")
file(WRITE ${WORK}/${name}/b.cpp "#include \"a/a.h\"\nnamespace wireskin::b {\nstatic int f(int x) { return x; }\nstruct Later;\nint k(char); // it's \\\"\nint l = k('\\\"') + k(\"\\\"\"[0]);  // isn't\n}  // namespace wireskin::b\n")
amalgamate(${name})
if(NOT result EQUAL 0)
  message(SEND_ERROR "accepts: ${error}")
endif()
file(READ ${WORK}/${name}.h header)
string(REPLACE "}  // namespace wireskin::a" "}  /* namespace wireskin::a */" body "${body}")
string(FIND "${header}" "${body}" found)
if(found LESS 0)
  message(SEND_ERROR "the text of a source did not come through unchanged")
endif()
