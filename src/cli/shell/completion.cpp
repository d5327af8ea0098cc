#include "cli/shell/completion.hpp"

#include <sstream>

namespace faqem::cli {

namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text.append(text.empty() ? "" : " ").append(word);
    return text;
}

std::string all_names(const std::vector<OptionInfo>& options) {
    std::vector<std::string> names;
    for (const OptionInfo& option : options)
        names.insert(names.end(), option.names.begin(), option.names.end());
    return joined(names);
}

std::string command_names(const CommandTree& tree, const char* between) {
    std::string text;
    for (const CommandInfo& command : tree.commands)
        text.append(text.empty() ? "" : between).append(command.name);
    return text;
}

/// The words that an argument can be, where they are not files.
std::string argument_words(const CommandInfo& command) {
    return command.name == "completion" ? "bash zsh" : "";
}

std::string bash_case(const CommandInfo& command) {
    std::ostringstream text;
    text << "        " << command.name << ")\n            options='" << all_names(command.options) << "'\n";
    if (const std::string words = argument_words(command); !words.empty())
        text << "            words='" << words << "'\n";
    text << "            case $previous in\n";
    for (const OptionInfo& option : command.options) {
        if (option.choices.empty()) continue;
        for (const std::string& name : option.names)
            text << "                " << name << ") words='" << joined(option.choices) << "' options= ;;\n";
    }
    text << "            esac ;;\n";
    return text.str();
}

/// For zsh inside of single quotes and brackets.
std::string zsh_escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\'')
            result += "'\\''";
        else if (c == '[' || c == ']' || c == ':' || c == '\\')
            result.append("\\").push_back(c);
        else
            result += c;
    }
    return result;
}

std::string zsh_option(const OptionInfo& option) {
    std::ostringstream text;
    for (const std::string& name : option.names) {
        text << "            '" << name << "[" << zsh_escaped(option.description) << "]";
        if (!option.choices.empty())
            text << ":value:(" << joined(option.choices) << ")";
        else if (!option.value_name.empty())
            text << ":" << zsh_escaped(option.value_name) << ":"
                 << (option.value_name == "FILE" ? "_files" : "");
        text << "' \\\n";
    }
    return text.str();
}

std::string zsh_case(const CommandInfo& command) {
    std::ostringstream text;
    text << "    " << command.name << ")\n        _arguments \\\n";
    for (const OptionInfo& option : command.options) text << zsh_option(option);
    const std::string words = argument_words(command);
    text << "            '*:argument:";
    if (words.empty())
        text << "_files";
    else
        text << "(" << words << ")";
    text << "' ;;\n";
    return text.str();
}

}  // namespace

std::string bash_completion(const CommandTree& tree) {
    std::ostringstream text;
    text << "# Completion of faqem for bash, made by `faqem completion bash`.\n"
            "_faqem() {\n"
            "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
            "    local command= options= words= i\n"
            "    for ((i = 1; i < COMP_CWORD; ++i)); do\n"
            "        case ${COMP_WORDS[i]} in\n"
            "        "
         << command_names(tree, "|")
         << ") command=${COMP_WORDS[i]}; break ;;\n"
            "        esac\n"
            "    done\n"
            "    case $command in\n"
            "        '') options='"
         << all_names(tree.options) << "' words='" << command_names(tree, " ") << "' ;;\n";
    for (const CommandInfo& command : tree.commands) text << bash_case(command);
    // Without an answer, readline completes file names.
    text << "    esac\n"
            "    if [[ $current == -* && -n $options ]]; then words=$options; fi\n"
            "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
            "}\n"
            "complete -o default -F _faqem faqem\n";
    return text.str();
}

std::string zsh_completion(const CommandTree& tree) {
    std::ostringstream text;
    text << "#compdef faqem\n"
            "# Completion of faqem for zsh, made by `faqem completion zsh`.\n"
            "_faqem() {\n"
            "    local -a commands=(\n";
    for (const CommandInfo& command : tree.commands)
        text << "        '" << command.name << ":" << zsh_escaped(command.description) << "'\n";
    text << "    )\n"
            "    if (( CURRENT == 2 )); then\n"
            "        _describe command commands\n"
            "        return\n"
            "    fi\n"
            "    shift words\n"
            "    (( CURRENT-- ))\n"
            "    case $words[1] in\n";
    for (const CommandInfo& command : tree.commands) text << zsh_case(command);
    text << "    esac\n"
            "}\n"
            "if [[ $funcstack[1] == _faqem ]]; then _faqem \"$@\"; else compdef _faqem faqem; fi\n";
    return text.str();
}

}  // namespace faqem::cli
