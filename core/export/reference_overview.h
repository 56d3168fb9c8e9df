// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace posewire::exporting {

/// One thing in which the revisions of the specification, or senders, differ.
struct RevisionDifference {
    std::string_view topic;
    std::string_view e;     ///< revision E, 2012
    std::string_view jAndK; ///< revisions J and K, 2015 and 2017
    std::string_view later; ///< revisions L to N since 2018, and what their senders really do
};

[[nodiscard]] std::span<const RevisionDifference> revisionDifferences();

/// The first part of the protocol reference in Markdown: all types in one table, with links to their
/// sections, and what differs between revisions.
[[nodiscard]] std::string referenceOverview();

/// What the heading `title` is linked by: lower case, words joined by hyphens, as most readers of Markdown
/// have it.
[[nodiscard]] std::string headingAnchor(std::string_view title);

} // namespace posewire::exporting
