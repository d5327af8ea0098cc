# Makes a C++ file of a text: cmake -DNAME=page_html -DTEXT=page.html -DOUT=page_html.cpp -P embed.cmake
file(READ ${TEXT} text)
string(FIND "${text}" ")faqem\"" end)
if(NOT end EQUAL -1)
    message(FATAL_ERROR "${TEXT} has in it what ends a raw string")
endif()
file(WRITE ${OUT} "#include \"cli/report/embedded_files.hpp\"\n\nconst std::string_view faqem::cli::${NAME} = R\"faqem(${text})faqem\";\n")
