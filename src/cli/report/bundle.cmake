# Bundles the viewer with npm:
#   cmake -DNPM=npm -DSOURCE=viewer -DWORK=folder -DOUT=viewer.js -DREQUIRED=ON -P bundle.cmake
# Installs the packages of package-lock.json, whose checksums npm verifies, without running their install
# scripts. If this fails, for example without a network, it is an error if REQUIRED is set; otherwise OUT is
# empty and reports have no 3D view.
set(limit TIMEOUT 120)  # so that an unresponsive network does not block the build
file(COPY ${SOURCE}/ DESTINATION ${WORK} PATTERN node_modules EXCLUDE PATTERN .gitignore EXCLUDE)
execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --prefer-offline --fetch-retries=0
                        --fetch-timeout=20000
                WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output ${limit})
if(NOT failed)
    execute_process(COMMAND ${NPM} run --silent build -- --log-level=warning --outfile=${OUT}
                    WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output ${limit})
endif()
if(failed AND REQUIRED)
    message(FATAL_ERROR "npm failed to bundle the viewer: ${output}")
elseif(failed)
    message("-- npm failed to bundle the viewer: `faqem report` is built without a 3D view")
    file(WRITE ${OUT} "")
endif()
