# cmake -DOUTPUT=FILE -DMAIN=result|app [-DAS=cpp] -P assemble.cmake
#
# Puts page.html, style.css and the modules into one page. MAIN is the module that runs last. A page
# of MAIN=result has the marks <!--title--> and <!--scene--> where the command writes a result; AS=cpp
# writes it as an array of bytes for the command to hold.
cmake_minimum_required(VERSION 3.25)
set(here ${CMAKE_CURRENT_LIST_DIR})

# Modules are joined in this order; each uses only what stands before it, so imports and exports go.
set(script "")
foreach(module vec scene camera renderer viewer ${MAIN})
  file(READ ${here}/${module}.js text)
  string(REGEX REPLACE "(^|\n)import [^\n]*" "\\1" text "${text}")
  string(REGEX REPLACE "(^|\n)export " "\\1" text "${text}")
  string(APPEND script "${text}")
endforeach()
if(script MATCHES "</script")
  message(FATAL_ERROR "a module holds </script, which would end it in the page")
endif()

file(READ ${here}/page.html page)
file(READ ${here}/style.css style)
set(scene "")
set(title "wireskin")
if(MAIN STREQUAL "result")
  set(title "<!--title-->")
  set(scene "<script type=\"application/octet-stream\" id=\"scene\"><!--scene--></script>")
endif()
string(REPLACE "@TITLE@" "${title}" page "${page}")
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@SCENE@" "${scene}" page "${page}")
string(REPLACE "@SCRIPT@" "${script}" page "${page}")
file(WRITE ${OUTPUT} "${page}")

if(AS STREQUAL "cpp")
  file(READ ${OUTPUT} bytes HEX)
  string(REGEX REPLACE "(................................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  file(WRITE ${OUTPUT}
"// Made from examples/web by assemble.cmake.
#include \"write_page.h\"

namespace wireskin_cli {
static const unsigned char k_bytes[] = {
${bytes}};
const std::string_view k_page(reinterpret_cast<const char*>(k_bytes), sizeof k_bytes);
}  // namespace wireskin_cli
")
endif()
