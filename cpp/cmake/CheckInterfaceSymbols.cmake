# Fails if an interface calls anything but mathematics, or keeps data that can change: no heap, no exceptions, no exit,
# no output, no statics. The sanitizers add calls of their own, so it is not for their builds.
set(allowed "exp|expm1|log|log10|log1p|pow|sqrt|floor|memcpy|memset|memmove|strlen|_GLOBAL_OFFSET_TABLE_|__stack_chk_fail|stdb_abqerr_")
foreach(object ${OBJECTS})
  execute_process(COMMAND "${NM}" "${object}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" symbols "${symbols}")
  foreach(symbol ${symbols})
    string(REGEX REPLACE "^[0-9a-f ]*[a-zA-Z] " "" name "${symbol}")
    if(symbol MATCHES "^ *[UvwC] " AND NOT name MATCHES "^(${allowed})$")
      message(SEND_ERROR "${object} needs ${name}")
    elseif(symbol MATCHES "^[0-9a-f]+ [bBdDgGsS] " AND NOT name MATCHES "^ProbationDNLR_")  # MGIS' declarations
      message(SEND_ERROR "${object} keeps data that can change: ${name}")
    endif()
  endforeach()
endforeach()
