# SPDX-License-Identifier: BSD-3-Clause
# cmake -DNAME=n -DINPUT=file -DOUTPUT=file.cpp -P embed_text.cmake: see FildEmbed.cmake.
file(SIZE "${INPUT}" size)
set(literals "")
set(chunk 12000) # compilers need only take 64 KiB in one literal
foreach(begin RANGE 0 ${size} ${chunk})
  file(READ "${INPUT}" bytes OFFSET ${begin} LIMIT ${chunk} HEX)
  string(REGEX REPLACE "(..)" "\\\\x\\1" escaped "${bytes}")
  string(APPEND literals "    \"${escaped}\"\n")
endforeach()
file(WRITE "${OUTPUT}"
  "#include <string_view>\nnamespace fild\n{\n"
  "extern const std::string_view ${NAME};\n"
  "const std::string_view ${NAME}(\n${literals},\n    ${size});\n}\n")
