# Fails if an object compiled for v3 defines a symbol outside the namespace v3 that another object could define too:
# the linker keeps one copy of such a symbol, and this one stops on older processors.
foreach(object ${OBJECTS})
  execute_process(COMMAND "${NM}" --demangle --defined-only "${object}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE ";" "," symbols "${symbols}")
  string(REPLACE "\n" ";" symbols "${symbols}")
  foreach(symbol ${symbols})
    if(symbol MATCHES "^[0-9a-f]* [TWVuBDR] " AND NOT symbol MATCHES "v3::")
      message(SEND_ERROR "${object} defines a shared symbol: ${symbol}")
    endif()
  endforeach()
endforeach()
