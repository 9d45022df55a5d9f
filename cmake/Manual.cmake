# Writes the manual pages and completions that the command prints.
#   cmake -DSVT=<command> -DOUTPUT=<folder> -P cmake/Manual.cmake
function(describe file)
  execute_process(COMMAND ${SVT} describe ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${OUTPUT}/${file} "${text}")
endfunction()

describe(svt.bash bash)
describe(_svt zsh)
describe(svt.fish fish)
describe(man1/svt.1 man)
execute_process(COMMAND ${SVT} describe json OUTPUT_VARIABLE described COMMAND_ERROR_IS_FATAL ANY)
string(JSON count LENGTH "${described}" commands)
math(EXPR last "${count} - 1")
foreach(n RANGE ${last})
  string(JSON name GET "${described}" commands ${n} name)
  describe(man1/svt-${name}.1 man ${name})
endforeach()
