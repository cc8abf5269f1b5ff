# SPDX-License-Identifier: BSD-3-Clause

# fild_embed_text(<target> <name> <file>): the file as `extern const std::string_view <name>` in
# namespace fild, part of the target. The program then needs no file at run time.
function(fild_embed_text target name file)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
  add_custom_command(OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DINPUT=${file} -DOUTPUT=${output}
      -P "${PROJECT_SOURCE_DIR}/libs/cmake/embed_text.cmake"
    DEPENDS "${file}" "${PROJECT_SOURCE_DIR}/libs/cmake/embed_text.cmake"
    VERBATIM)
  target_sources(${target} PRIVATE "${output}")
  fild_compile_alone("${output}")  # linting needs no built file then
endfunction()
