# cmake [-DSOURCE=src] -DOUTPUT=wireskin.h -P amalgamate.cmake
#
# Writes the single header: the public header and, under WIRESKIN_IMPLEMENTATION, every file of the
# library once. Headers stand before their users, in the order that their own #include lines give;
# then the sources in the order of their headers. Fails, with a sentence, on an include cycle, on a
# file that nothing uses, and on names that would collide in one translation unit.
cmake_minimum_required(VERSION 3.25)

if(NOT DEFINED SOURCE)
  set(SOURCE ${CMAKE_CURRENT_LIST_DIR}/../src)
endif()
get_filename_component(SOURCE ${SOURCE} ABSOLUTE)
if(NOT DEFINED OUTPUT)
  message(FATAL_ERROR "say where to write: -DOUTPUT=FILE")
endif()

# CMake lists give a meaning to these four characters; files are kept in this spelling until the end.
string(ASCII 1 k_semicolon)
string(ASCII 2 k_open)
string(ASCII 3 k_close)
string(ASCII 4 k_backslash)
string(ASCII 5 k_mark)

function(read_source path result)
  file(READ ${SOURCE}/${path} text)
  string(REPLACE "\r\n" "\n" text "${text}")
  string(REPLACE ";" "${k_semicolon}" text "${text}")
  string(REPLACE "[" "${k_open}" text "${text}")
  string(REPLACE "]" "${k_close}" text "${text}")
  string(REPLACE "\\" "${k_backslash}" text "${text}")
  # Fragments (.inc) are read anew at each place that includes them.
  string(REGEX MATCHALL "#include \"[^\"\n]+\\.inc\"" fragments "${text}")
  list(REMOVE_DUPLICATES fragments)
  foreach(fragment IN LISTS fragments)
    string(REGEX REPLACE "^#include \"(.*)\"$" "\\1" name "${fragment}")
    if(NOT EXISTS ${SOURCE}/${name})
      message(FATAL_ERROR "src/${path} includes \"${name}\", which src does not have")
    endif()
    read_source(${name} body)
    string(REPLACE "${fragment}" "${body}" text "${text}")
  endforeach()
  set(${result} "\n${text}" PARENT_SCOPE)
endfunction()

# ---- Reading: what each file includes -----------------------------------------------------------

file(GLOB_RECURSE all_files RELATIVE ${SOURCE} ${SOURCE}/*)
list(SORT all_files)
set(sources "")
set(headers "")
foreach(file IN LISTS all_files)
  if(file STREQUAL "wireskin.h")
    continue()
  elseif(file MATCHES "\\.cpp$")
    list(APPEND sources ${file})
  elseif(file MATCHES "\\.h$")
    list(APPEND headers ${file})
  elseif(file MATCHES "\\.inc$")
    continue()
  else()
    message(FATAL_ERROR "src/${file} is neither .h nor .cpp: it would be left out")
  endif()
endforeach()

set(system_includes "")
foreach(file IN LISTS sources headers)
  read_source(${file} text)
  set(uses "")
  set(depth 0)
  string(REGEX MATCHALL "\n[ \t]*#[^\n]*" directives "${text}")
  foreach(directive IN LISTS directives)
    string(STRIP "${directive}" directive)
    if(directive MATCHES "^# *if")
      math(EXPR depth "${depth} + 1")
    elseif(directive MATCHES "^# *endif")
      math(EXPR depth "${depth} - 1")
    elseif(directive MATCHES "^#include \"([^\"]+)\"")
      set(used ${CMAKE_MATCH_1})
      if(NOT EXISTS ${SOURCE}/${used})
        message(FATAL_ERROR "src/${file} includes \"${used}\", which src does not have")
      endif()
      if(depth GREATER 0)
        message(FATAL_ERROR "src/${file} includes \"${used}\" under a condition")
      endif()
      if(NOT used STREQUAL "wireskin.h")
        list(APPEND uses ${used})
      endif()
    elseif(directive MATCHES "^#include <([^>]+)>")
      # One under a condition (an intrinsics header) stays where it is.
      if(depth EQUAL 0)
        list(APPEND system_includes ${CMAKE_MATCH_1})
      endif()
    endif()
  endforeach()
  set(uses_of_${file} "${uses}")
  set(text_of_${file} "${text}")
endforeach()
list(REMOVE_DUPLICATES system_includes)
list(SORT system_includes)

# ---- Order: headers before their users, sources in the order of their headers ---------------------

set(order "")
macro(visit file chain)
  if("${state_of_${file}}" STREQUAL "open")
    message(FATAL_ERROR "the files of src include each other in a circle: ${chain} -> ${file}")
  endif()
  if(NOT DEFINED state_of_${file})
    set(state_of_${file} open)
    foreach(visited_use IN LISTS uses_of_${file})
      visit(${visited_use} "${chain} -> ${file}")
    endforeach()
    set(state_of_${file} done)
    list(APPEND order ${file})
  endif()
endmacro()

foreach(file IN LISTS sources)
  foreach(use IN LISTS uses_of_${file})
    visit(${use} ${file})
  endforeach()
endforeach()
foreach(file IN LISTS headers)
  if(NOT file IN_LIST order)
    visit(${file} "(a header nobody includes)")  # a circle is the better explanation
    message(FATAL_ERROR "src/${file} is included by no source")
  endif()
endforeach()
set(ordered_sources "")
set(sources_left ${sources})
foreach(file IN LISTS order)
  string(REGEX REPLACE "\\.h$" ".cpp" source ${file})
  if(source IN_LIST sources_left)
    list(APPEND ordered_sources ${source})
    list(REMOVE_ITEM sources_left ${source})
  endif()
endforeach()
list(APPEND order ${ordered_sources} ${sources_left})

# ---- Names: what separate translation units may repeat and one may not ----------------------------

# Only lines in the first column count: what is indented belongs to a function or a class.
set(definition_start
    "(static |struct |class |enum |union |constexpr |inline constexpr |const |using |typedef )")
set(macros "")
foreach(file IN LISTS order)
  set(text "${text_of_${file}}")
  if(text MATCHES "//[^\n]*/\\*")
    message(FATAL_ERROR "src/${file}: a slash and a star inside a // comment would swallow the rest "
                        "of the header in a C89 program")
  endif()

  # A C program skips the implementation but reads it as tokens: a lone quote in a // comment or
  # between digits would be an error. The comments are therefore written as /* */ at the end.
  if(text MATCHES "([0-9]+'[0-9]+)")
    message(FATAL_ERROR "src/${file}: write ${CMAKE_MATCH_1} without a separator between digits")
  endif()
  string(REGEX MATCHALL "\n[^\n\"/]*\"[^\n]*//" quoted_lines "${text}")
  foreach(line IN LISTS quoted_lines)
    string(REGEX REPLACE "//.*$" "" before "${line}")
    string(REGEX REPLACE "${k_backslash}\"" "" before "${before}")
    string(REGEX REPLACE "\"[^\"]*\"" "" before "${before}")
    if(before MATCHES "\"")
      message(FATAL_ERROR "src/${file}: a string with two slashes would become a comment: ${line}")
    endif()
  endforeach()

  # Marks split the text at namespaces and at definitions.
  string(REGEX REPLACE "\n(namespace [^\n{]*{|namespace {|}  // namespace[^\n]*)" "\n${k_mark}\\1"
         text "${text}")
  string(REGEX REPLACE "\n${definition_start}" "\n${k_mark}\\1" text "${text}")
  string(REGEX MATCHALL "${k_mark}}[^\n]*|${k_mark}[^=({${k_semicolon}${k_mark}]*[=({${k_semicolon}]" parts
         "${text}")
  set(namespaces "")
  foreach(part IN LISTS parts)
    if(part MATCHES "^${k_mark}namespace ([A-Za-z0-9_:]+) *{")
      list(APPEND namespaces "${CMAKE_MATCH_1}")
    elseif(part MATCHES "^${k_mark}namespace *{")
      list(APPEND namespaces "(unnamed)")
    elseif(part MATCHES "^${k_mark}}")
      list(POP_BACK namespaces)
    elseif(part MATCHES "^${k_mark}(struct|class|enum|union) .*${k_semicolon}$")
      # A declaration; repeating it is fine.
    else()
      string(REGEX REPLACE "${k_open}${k_open}[^${k_close}]*${k_close}${k_close}" "" part "${part}")
      string(REGEX REPLACE "${k_open}[^${k_close}]*${k_close}" "" part "${part}")
      if(part MATCHES "^${k_mark}(struct|class|enum|union) ")
        string(REGEX REPLACE " (:|final).*$" "{" part "${part}")
      endif()
      if(part MATCHES "([A-Za-z_][A-Za-z0-9_]*)[ \n]*[=({${k_semicolon}]$")
        set(name ${CMAKE_MATCH_1})
        list(JOIN namespaces "::" space)
        string(REPLACE "::(unnamed)" "" space "${space}")
        set(key "${space}::${name}")
        if(DEFINED owner_of_${key} AND NOT owner_of_${key} STREQUAL file)
          message(FATAL_ERROR "${key} is defined in src/${owner_of_${key}} and in src/${file}: "
                              "names must be unique in a folder's namespace")
        endif()
        set(owner_of_${key} ${file})
      endif()
    endif()
  endforeach()

  string(REGEX MATCHALL "\n[ \t]*# *define [A-Za-z0-9_]+" defines "${text_of_${file}}")
  foreach(define IN LISTS defines)
    string(REGEX REPLACE "^.*define " "" name "${define}")
    if(DEFINED macro_owner_${name} AND NOT macro_owner_${name} STREQUAL file)
      message(FATAL_ERROR "the macro ${name} is defined in src/${macro_owner_${name}} and in "
                          "src/${file}")
    endif()
    set(macro_owner_${name} ${file})
    list(APPEND macros ${name})
  endforeach()
endforeach()
list(REMOVE_DUPLICATES macros)
list(SORT macros)

# ---- Writing ------------------------------------------------------------------------------------

read_source(wireskin.h public_header)
string(SUBSTRING "${public_header}" 1 -1 public_header)

set(save_macros "")
set(restore_macros "")
foreach(name IN LISTS macros)
  string(APPEND save_macros "#pragma push_macro(\"${name}\")\n#undef ${name}\n")
  string(APPEND restore_macros "#undef ${name}\n#pragma pop_macro(\"${name}\")\n")
endforeach()
set(system_lines "")
foreach(name IN LISTS system_includes)
  string(APPEND system_lines "#include <${name}>\n")
endforeach()

set(output "/* Generated by single_include/amalgamate.cmake: change the files in src/ instead.
 *
 * Define WIRESKIN_IMPLEMENTATION in exactly one C++17 file before including this header; all other
 * files, C or C++, include it as it is. A processor with fused multiply-add needs no flag: the
 * implementation switches contraction off for itself (with clang, do not pass -ffp-contract=fast,
 * which overrides that). */
")
string(APPEND output "${public_header}" "
#if defined(WIRESKIN_IMPLEMENTATION) && !defined(WIRESKIN_IMPLEMENTED)
#define WIRESKIN_IMPLEMENTED

#if !defined(__cplusplus) || \\
    (__cplusplus < 201703L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 201703L))
#error \"the implementation of wireskin is C++17: compile the file that defines WIRESKIN_IMPLEMENTATION so\"
#endif

${system_lines}
/* What the includer's macros and floating-point settings were, they are again at the end. */
${save_macros}#if defined(__clang__)
#ifndef __wasm__ /* which has no such setting to save */
#pragma float_control(push)
#endif
#elif defined(__GNUC__)
#pragma GCC push_options
#if __GNUC__ >= 11 /* drops stores of small structs passed by value, see CMakeLists.txt */
#pragma GCC optimize(\"no-ipa-modref\")
#endif
#elif defined(_MSC_VER)
#pragma float_control(push)
#endif
")
foreach(file IN LISTS order)
  set(text "${text_of_${file}}")
  string(REGEX REPLACE "\n#include \"[^\n]*" "" text "${text}")
  # Those in the first column are unconditional but for a few, which keep their place.
  foreach(name IN LISTS system_includes)
    string(REPLACE "\n#include <${name}>" "" text "${text}")
  endforeach()
  string(REGEX REPLACE "\n#pragma once" "" text "${text}")
  string(REGEX REPLACE "//([^\n]*)" "/*\\1 */" text "${text}")
  string(REGEX REPLACE "\n\n\n+" "\n\n" text "${text}")
  string(REGEX REPLACE "\n+$" "\n" text "${text}")
  string(REGEX REPLACE "^\n+" "" text "${text}")
  string(APPEND output "\n/* ======== begin src/${file} ======== */\n${text}"
                       "/* ======== end src/${file} ======== */\n")
endforeach()
string(APPEND output "
#if defined(__clang__)
#ifndef __wasm__
#pragma float_control(pop)
#endif
#elif defined(__GNUC__)
#pragma GCC pop_options
#elif defined(_MSC_VER)
#pragma float_control(pop)
#endif
${restore_macros}
#endif /* WIRESKIN_IMPLEMENTATION */
")

string(REPLACE "${k_semicolon}" ";" output "${output}")
string(REPLACE "${k_open}" "[" output "${output}")
string(REPLACE "${k_close}" "]" output "${output}")
string(REPLACE "${k_backslash}" "\\" output "${output}")
file(WRITE ${OUTPUT} "${output}")
