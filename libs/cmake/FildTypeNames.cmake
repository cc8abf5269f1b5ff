# SPDX-License-Identifier: BSD-3-Clause

option(FILD_CHECK_TYPE_NAMES "Add the target type_names: finds types of one name that differ between files" OFF)

# fild_keep_types(<target>): its object files also hold what the linker compares types by.
function(fild_keep_types target)
  if(NOT FILD_CHECK_TYPE_NAMES)
    return()
  endif()
  target_compile_options(${target} PRIVATE -flto -ffat-lto-objects)
  # Programs, a consumer's too, are linked from the code in them as ever.
  target_link_options(${target} PUBLIC -fno-lto)
  set_property(GLOBAL APPEND PROPERTY FILD_TYPED_TARGETS ${target})
endfunction()

# fild_add_type_names(): target type_names, which joins the object files of all libraries and apps in no
# more than their types, and fails where two types of one name differ. Each app has a main().
function(fild_add_type_names)
  if(NOT FILD_CHECK_TYPE_NAMES)
    return()
  endif()
  get_property(targets GLOBAL PROPERTY FILD_TYPED_TARGETS)
  list(TRANSFORM targets REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE objects)
  add_custom_command(OUTPUT type_names.o
    COMMAND ${CMAKE_CXX_COMPILER} -r -nostdlib -flto -flinker-output=rel -O0 -Wl,-z,muldefs
      -Werror=odr -Werror=lto-type-mismatch -o type_names.o ${objects}
    DEPENDS ${objects}
    COMMENT "Comparing types of one name"
    COMMAND_EXPAND_LISTS VERBATIM)
  add_custom_target(type_names DEPENDS type_names.o)
endfunction()
