# Bundles the viewer with npm:
#   cmake -DNPM=npm -DSOURCE=viewer -DWORK=folder -DOUT=viewer.js -DREQUIRED=ON -P bundle.cmake
# Fetches what package-lock.json names, by checksum, and runs none of its scripts. Where that fails, as on a machine
# without network, it is an error if REQUIRED; else OUT is empty, and the report says that there is no 3D view.
set(limit TIMEOUT 120)  # no build waits for a network that swallows everything
file(COPY ${SOURCE}/ DESTINATION ${WORK} PATTERN node_modules EXCLUDE PATTERN .gitignore EXCLUDE)
execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --prefer-offline --fetch-retries=0
                        --fetch-timeout=20000
                WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output ${limit})
if(NOT failed)
    execute_process(COMMAND ${NPM} run --silent build -- --log-level=warning --outfile=${OUT}
                    WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output ${limit})
endif()
if(failed AND REQUIRED)
    message(FATAL_ERROR "npm cannot bundle the viewer: ${output}")
elseif(failed)
    message("-- npm cannot bundle the viewer: `faqem report` is built without its 3D view")
    file(WRITE ${OUT} "")
endif()
