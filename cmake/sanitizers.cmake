# SPDX-License-Identifier: Apache-2.0

# Every finding ends the program: otherwise a test with findings could pass.
if(LEXICAN_SANITIZE)
  add_compile_options(-fsanitize=${LEXICAN_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LEXICAN_SANITIZE})
endif()
