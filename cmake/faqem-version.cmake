# Sets faqem_version to MAJOR.MINOR.PATCH, as defined in include/faqem/version.hpp.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/../include/faqem/version.hpp faqem_lines
     REGEX "version_(major|minor|patch) = [0-9]+;")
string(REGEX REPLACE ".* version_major = ([0-9]+).* version_minor = ([0-9]+).* version_patch = ([0-9]+).*"
                     "\\1.\\2.\\3" faqem_version "${faqem_lines}")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
             ${CMAKE_CURRENT_LIST_DIR}/../include/faqem/version.hpp)
