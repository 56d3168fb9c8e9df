// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/stage/server.h"
#include "core/log/recording_file.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::stage {

/// Takes the batches of all probes of a site as a stream has them: each packet once, in the order of its
/// probe, with the name of that in its sender.
class BatchOrder {
public:
    struct Taken {
        std::string probe;           ///< empty if the subject names none
        std::uint64_t packets = 0;   ///< that did not come before
        std::uint64_t lostOnWay = 0; ///< packets that the probe numbered before these and that did not come
        std::string problem;         ///< of the batch or of the probe; empty if all is well
    };
    /// Calls `visit` for each new packet. If packets are missing before it, a record with
    /// PacketFlags::isLostOnWay comes first.
    Taken take(const Message& batch, const log::FileVisitor& visit);

private:
    /// How far a probe has come.
    struct Course {
        std::string run;
        std::set<std::string> runsBefore;
        std::uint64_t next = 0;                 ///< number of the packet after the last one that came
        std::vector<std::uint64_t> signs{};     ///< of the packets of the last batch
        std::vector<std::uint64_t> repeating{}; ///< of those that the run may begin with once more
    };
    [[nodiscard]] bool isNews(Course& course, const Message& batch, Taken& taken) const;

    std::map<std::string, Course> m_courses;
};

/// A site or probe is named in subjects, files and tables: letters, digits, - and _, 64 at most.
[[nodiscard]] bool isName(const std::string& name);

/// Decimal digits alone.
[[nodiscard]] std::optional<std::uint64_t> numberOf(std::string_view text);

/// "STAGE-A" of "posewire.SITE.STAGE-A.batch"; empty if it is no name.
[[nodiscard]] std::string probeOf(const Message& message);

} // namespace posewire::stage
