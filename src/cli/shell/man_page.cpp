#include "cli/shell/man_page.hpp"

namespace faqem::cli {

namespace {

/// Escapes text so that troff prints it literally.
std::string escape_troff(std::string_view text) {
    std::string result;
    bool at_line_start = true;
    for (const char c : text) {
        if (at_line_start && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
        at_line_start = c == '\n';
    }
    return result;
}

std::string in_font(char font, std::string_view text) {
    return std::string("\\f") + font + escape_troff(text) + "\\fR";
}
std::string bold(std::string_view text) { return in_font('B', text); }
std::string italic(std::string_view text) { return in_font('I', text); }

std::string entry(const OptionInfo& option) {
    const bool is_option = option.names.front().starts_with('-');
    std::string text = ".TP\n";
    for (std::size_t i = 0; i < option.names.size(); ++i)
        text.append(i > 0 ? ", " : "").append((is_option ? bold : italic)(option.names[i]));
    if (is_option && option.kind != detail::OptionKind::flag)
        text.append(" ").append((choices_of(option).empty() ? italic : escape_troff)(option.value_name));
    return text.append("\n").append(escape_troff(option.description)).append("\n");
}

std::string section(const CommandInfo& command) {
    std::string text = ".SS ";
    text += bold(std::string("faqem ") + command.name);
    for (const OptionInfo& positional : command.positionals)
        text.append(" ").append(italic(positional.names.front()));
    text.append("\n").append(escape_troff(command.description)).append(".\n");
    for (const OptionInfo& positional : command.positionals) text += entry(positional);
    for (const OptionInfo& option : command.options) text += entry(option);
    return text;
}

}  // namespace

std::string man_page(const CommandTree& tree, std::string_view version) {
    std::string text = ".TH FAQEM 1 \"\" \"faqem ";
    text.append(version).append("\" \"User Commands\"\n");
    text += ".SH NAME\nfaqem \\- mesh simplification with texture baking\n";
    text.append(".SH SYNOPSIS\n").append(bold("faqem")).append(" ").append(italic("COMMAND"));
    text.append(" [").append(italic("OPTION")).append("]...\n");
    text.append(".SH DESCRIPTION\n").append(escape_troff(tree.description)).append("\n");
    for (const OptionInfo& option : tree.options) text += entry(option);
    text += ".SH COMMANDS\n";
    for (const CommandInfo& command : tree.commands) text += section(command);
    text.append(".SH EXIT STATUS\n").append(escape_troff(tree.exit_codes)).append("\n");
    text += ".SH EXAMPLES\n.nf\n";
    for (const CommandInfo& command : tree.commands) {
        for (const std::string& example : command.examples) text.append(escape_troff(example)).append("\n");
    }
    return text + ".fi\n";
}

}  // namespace faqem::cli
