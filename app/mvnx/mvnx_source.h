// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/mvnx/frame.h"

#include "core/log/pcapng_writer.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace posewire::mvnx {

/// True if a file that begins with these bytes is MVNX: XML whose first element is <mvnx>. The first
/// kLookedAt bytes decide.
inline constexpr std::size_t kLookedAt = 4096;
[[nodiscard]] bool isMvnx(std::span<const std::byte> head);

/// Reads MVNX of versions 3 and 4 as the recording of a stream (pcapng): of each frame the types 02, 20, 21,
/// 22, 23, 24 and 25 that it has values for, with its index as the sample counter, at its place in the frame
/// rate; once a second types 12 and 13. Each subject is a character, all of one sender with the name of the
/// file. Several subjects come one after the other, as they are in the file. Whatever does not begin as MVNX
/// comes as it is. Memory does not grow with the file. A file that is cut off or damaged is read up to there.
class MvnxSource final : public log::ByteSource {
public:
    explicit MvnxSource(std::unique_ptr<log::ByteSource> source);
    ~MvnxSource() override;

    tl::expected<std::size_t, log::FileError> read(std::span<std::byte> into) override;
    [[nodiscard]] std::string name() const override { return m_source->name(); }

private:
    class Reader;
    tl::expected<void, log::FileError> begin();

    std::unique_ptr<log::ByteSource> m_source;
    std::unique_ptr<Reader> m_reader; ///< null if it is no MVNX
    std::vector<std::byte> m_ready;   ///< bytes to be handed out
    std::size_t m_given = 0;          ///< of those
    bool m_hasBegun = false;
};

/// log::openFile(), through MvnxSource.
tl::expected<std::unique_ptr<log::ByteSource>, log::FileError> openFile(const std::string& path,
                                                                        log::IsCancelled isCancelled = {});

} // namespace posewire::mvnx
