// SPDX-License-Identifier: GPL-3.0-or-later
// MVNX files with anything in them: read to their end or to a failure that names the file.
#include "app/mvnx/mvnx_source.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

namespace {

using namespace posewire;

class Bytes final : public log::ByteSource {
public:
    explicit Bytes(std::span<const std::byte> bytes) : m_bytes(bytes) {}
    tl::expected<std::size_t, log::FileError> read(std::span<std::byte> into) override {
        const std::size_t count = std::min(into.size(), m_bytes.size());
        std::copy_n(m_bytes.begin(), count, into.begin());
        m_bytes = m_bytes.subspan(count);
        return count;
    }
    [[nodiscard]] std::string name() const override { return "x.mvnx"; }

private:
    std::span<const std::byte> m_bytes;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    mvnx::MvnxSource source(
        std::make_unique<Bytes>(std::span(reinterpret_cast<const std::byte*>(data), size)));
    std::vector<std::byte> piece(4096);
    while (true) {
        const auto count = source.read(piece);
        if (count && *count != 0) {
            continue;
        }
        if (!count && !count.error().text.starts_with("x.mvnx: ")) {
            std::abort();
        }
        return 0;
    }
}
