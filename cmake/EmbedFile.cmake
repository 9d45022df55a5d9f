# svt_embed_file(<target> <file> <symbol>): embeds the bytes of the file as `extern "C" const unsigned char <symbol>[]`
# and `<symbol>_size` in a source of the target.
function(svt_embed_file target file symbol)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${symbol}.cpp)
  if(NOT EXISTS ${source} OR ${file} IS_NEWER_THAN ${source})
    file(READ ${file} bytes HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
    file(WRITE ${source} "#include <cstddef>\nextern \"C\" {\nextern const unsigned char ${symbol}[];\n"
      "extern const std::size_t ${symbol}_size;\nconst unsigned char ${symbol}[] = {${bytes}};\n"
      "const std::size_t ${symbol}_size = sizeof ${symbol};\n}\n")
  endif()
  target_sources(${target} PRIVATE ${source})
endfunction()
