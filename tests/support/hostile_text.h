// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

/// Names as nobody would send them who means well.
namespace posewire::test {

/// None has a line break, so that each is one line of metadata.
inline std::vector<std::string> hostileNames() {
    return {"<img src=\"file:///etc/hostname\">",
            "&lt;img src='file:///etc/hostname'&gt;",
            "<b>bold</b><script>alert(1)</script>",
            "=HYPERLINK(\"http://x\",\"y\")",
            "@SUM(1+1)*cmd|' /C calc'!A0",
            "../../x",
            "/etc/passwd",
            "gpj.\u202eexe\u2066\u200b\u061c",
            "\x1b]0;title\x07\x1b[2J\x7f\xc2\x9b\x31m\t\r",
            "\xff\xfe\xc3 no UTF-8 \xed\xa0\x80",
            "%1 %2 %n {} &Name",
            std::string(60'000, 'x')};
}

/// The longest run of one character: of what 60,000 of them are shown as.
inline std::size_t longestRun(std::string_view text, char of = 'x') {
    std::size_t longest = 0;
    std::size_t run = 0;
    for (const char character : text) {
        run = character == of ? run + 1 : 0;
        longest = std::max(longest, run);
    }
    return longest;
}

/// What no text may hold that people look at: controls but for line breaks, overrides of direction,
/// characters without width, and more of a name than fits. Empty where there is none of it.
inline std::string harmIn(std::string_view text) {
    for (const char character : text) {
        if ((static_cast<unsigned char>(character) < 0x20 && character != '\n') || character == 0x7f) {
            return "a control character";
        }
    }
    for (const std::string_view unseen : {"\u202e", "\u2066", "\u200b", "\u061c", "\u009b"}) {
        if (text.find(unseen) != std::string_view::npos) {
            return "a character that is not seen";
        }
    }
    return longestRun(text) > 256 ? "all of a long name" : "";
}

} // namespace posewire::test
