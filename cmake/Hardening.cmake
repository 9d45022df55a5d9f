# Hardening of what is shipped: a defect that an input reaches ends the program instead of running the input's code.
# scripts/check_hardening.sh checks the linked program (tests Hardening.*).
option(SVT_HARDENING "Harden the programs; OFF measures the cost" ON)
if(NOT SVT_HARDENING OR EMSCRIPTEN OR CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  return()  # WebAssembly has its own sandbox; sanitizers check more
endif()
include(CheckPIESupported)
check_pie_supported()
add_compile_options(-fstack-protector-strong -fstack-clash-protection)
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  add_compile_options(-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)  # needs optimization
endif()
add_compile_definitions(_GLIBCXX_ASSERTIONS)
add_link_options(-Wl,-z,relro,-z,now)
