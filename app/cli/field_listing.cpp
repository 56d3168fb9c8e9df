// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/field_listing.h"

#include "core/wire/field_tree.h"

namespace posewire::cli {
namespace {

void pad(std::string& text, std::size_t width) {
    text.append(text.size() < width ? width - text.size() : 0, ' ');
}

/// Line ends and other control characters of the sender must not reach the terminal.
std::string printable(const std::string& value) {
    std::string text;
    for (const char character : value) {
        if (character == '\n') {
            text += "\\n";
        } else {
            text += static_cast<unsigned char>(character) < 0x20 || character == 0x7f ? '.' : character;
        }
    }
    return text;
}

std::string row(const wire::FieldNode& node, std::size_t depth) {
    constexpr std::size_t offsetWidth = 8;
    constexpr std::size_t nameWidth = 30;
    std::string line = std::to_string(node.offset);
    line.insert(0, line.size() < offsetWidth ? offsetWidth - line.size() : 0, ' ');
    line.append(2 + 2 * depth, ' ').append(node.name);
    if (!node.value.empty()) {
        pad(line, offsetWidth + 2 + nameWidth);
        line.append("  ").append(printable(node.value));
        line.append(wire::unitSymbol(node.unit).empty() ? "" : "  ").append(wire::unitSymbol(node.unit));
    }
    return line + '\n';
}

} // namespace

std::string fieldListing(wire::Bytes bytes) {
    const wire::FieldTree tree = wire::fieldTree(bytes);
    std::string text;
    std::vector<std::size_t> depths;
    for (const wire::FieldNode& node : tree.nodes) {
        depths.push_back(node.parent < 0 ? 0 : depths[static_cast<std::size_t>(node.parent)] + 1);
        text += row(node, depths.back());
    }
    for (const wire::Notice& notice : tree.notices) {
        text += "  notice: " + wire::noticeText(notice) + '\n';
    }
    if (tree.fault) {
        text += "  error: " + wire::errorText(*tree.fault) + '\n';
    }
    return text;
}

} // namespace posewire::cli
