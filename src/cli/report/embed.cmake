# Embeds a text file in a C++ file: cmake -DNAME=page_html -DTEXT=page.html -DOUT=page_html.cpp -P embed.cmake
file(READ ${TEXT} text)
string(FIND "${text}" ")faqem\"" end)
if(NOT end EQUAL -1)
    message(FATAL_ERROR "${TEXT} contains the delimiter of the raw string: )faqem\"")
endif()
file(WRITE ${OUT} "#include \"cli/report/embedded_files.hpp\"\n\nconst std::string_view faqem::cli::${NAME} = R\"faqem(${text})faqem\";\n")
