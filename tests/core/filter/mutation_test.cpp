// SPDX-License-Identifier: MIT
#include "core/export/json.h"
#include "core/filter/filter.h"
#include "core/wire/field_tree.h"
#include "tests/support/golden.h"

#include <gtest/gtest.h>

#include <random>

// 200,000 damaged datagrams of all types: nothing crashes, and all readers agree about what is wrong and
// where.
namespace posewire::filter {
namespace {

constexpr std::size_t kMutations = 50'000;

/// Copies of the goldens, damaged in ways that networks and faulty senders have.
class Mutator {
public:
    const std::vector<std::byte>& next() {
        const auto& goldens = posewire::test::goldens();
        m_bytes = goldens[pick(goldens.size())].bytes;
        const std::size_t changes = 1 + pick(4);
        for (std::size_t i = 0; i < changes; ++i) {
            change();
        }
        return m_bytes;
    }
    std::size_t pick(std::size_t below) { return below == 0 ? 0 : m_random() % below; }

private:
    void change() {
        const std::size_t size = m_bytes.size();
        const std::size_t place = pick(size);
        const auto at = m_bytes.begin() + static_cast<std::ptrdiff_t>(place);
        switch (pick(8)) {
        case 0:
            m_bytes.resize(place);
            break;
        case 1:
            m_bytes.resize(size + pick(64), std::byte{0});
            break;
        case 2:
            m_bytes.insert(at, 1 + pick(8), static_cast<std::byte>(pick(256)));
            break;
        case 3:
            m_bytes.erase(at, at + static_cast<std::ptrdiff_t>(pick(std::min<std::size_t>(9, size - place))));
            break;
        case 4: // counts and lengths are near the front, and their extremes hurt most
            overwrite(pick(std::min<std::size_t>(size, 40)));
            break;
        case 5:
            overwrite(place);
            break;
        case 6:
            retype();
            break;
        default:
            flip(place, pick(8));
        }
    }
    void overwrite(std::size_t place) {
        constexpr std::array<std::uint32_t, 8> extremes{0,          0xffffffff, 0x7fffffff, 0x80000000,
                                                        0x7fc00000, 0x7f800000, 0x00010000, 1};
        const std::uint32_t word = extremes[pick(extremes.size())];
        for (std::size_t i = 0; i < 4 && place + i < m_bytes.size(); ++i) {
            m_bytes[place + i] = static_cast<std::byte>(word >> (24 - 8 * i) & 0xff);
        }
    }
    void retype() {
        for (std::size_t i = 4; i < 6 && i < m_bytes.size(); ++i) {
            m_bytes[i] = static_cast<std::byte>('0' + pick(i == 4 ? 3 : 10));
        }
    }
    void flip(std::size_t place, std::size_t bit) {
        if (place < m_bytes.size()) {
            m_bytes[place] ^= std::byte{1} << bit;
        }
    }

    std::mt19937 m_random{20'260'131};
    std::vector<std::byte> m_bytes;
};

std::vector<Filter> filters() {
    std::vector<Filter> all;
    for (const char* text :
         {"segment == LeftHand && position.z > 0", "error contains \"trunc\" || notice == notFinite",
          "tag.name matches \"^[A-Z]+\" || text contains \"x\"",
          "position == NaN || orientation.w < 0 || flags > 0",
          "!(sample in 1..100) && (gap || duplicate || delta < 1) && source == \"x\""}) {
        all.push_back(*Filter::compile(text));
    }
    return all;
}

/// The fault as it is in JSON.
std::string jsonFault(const wire::WireError& error) {
    return "\"error\":{\"code\":\"" + std::string(wire::errorName(error.code)) +
           "\",\"offset\":" + std::to_string(error.offset);
}

void expectAgreement(wire::Bytes bytes, const tl::expected<void, wire::WireError>& decoded,
                     const wire::Datagram& datagram) {
    const wire::FieldTree tree = wire::fieldTree(bytes);
    const std::string json = exporting::datagramJson({}, bytes);
    ASSERT_EQ(decoded.has_value(), !tree.fault.has_value());
    if (decoded) {
        ASSERT_EQ(tree.notices, datagram.notices);
        ASSERT_EQ(json.find("\"error\":"), std::string::npos) << json;
    } else {
        ASSERT_EQ(*tree.fault, decoded.error());
        ASSERT_LE(decoded.error().offset, bytes.size());
        ASSERT_NE(json.find(jsonFault(decoded.error())), std::string::npos) << json;
    }
    constexpr std::size_t kMostNodes = 12; // a byte stands in one field, and few groups are around it
    ASSERT_LE(tree.nodes.size(), kMostNodes * (bytes.size() + 4));
}

TEST(Mutations, AreReadAlikeByAllReadersAndNeverFatal) {
    Mutator mutator;
    model::PacketDigester digester;
    const auto all = filters();
    wire::Datagram datagram;
    std::array<std::size_t, 2> outcomes{};
    std::size_t matched = 0;
    for (std::size_t i = 0; i < kMutations; ++i) {
        const auto& bytes = mutator.next();
        const auto decoded = wire::decodeInto(bytes, datagram);
        ++outcomes[decoded ? 1 : 0];
        ASSERT_NO_FATAL_FAILURE(expectAgreement(bytes, decoded, datagram)) << "mutation " << i;
        log::Packet packet;
        packet.number = i;
        packet.bytes = bytes;
        packet.stamp = log::Stamp(log::Duration(mutator.pick(1'000'000'000)));
        packet.sender = static_cast<log::SenderId>(mutator.pick(5000));
        const model::PacketDigest digest = digester.add(packet, decoded ? &datagram : nullptr);
        ASSERT_EQ(digest.kind == model::PacketKind::Datagram, decoded.has_value());
        for (const Filter& filter : all) {
            matched += filter.matches({packet, digest, decoded ? &datagram : nullptr}) ? 1 : 0;
        }
    }
    EXPECT_GT(outcomes[0], kMutations / 20) << "hardly anything was malformed: the mutations are too mild";
    EXPECT_GT(outcomes[1], kMutations / 20) << "hardly anything was readable: the mutations are too wild";
    EXPECT_GT(matched, 0U);
}

} // namespace
} // namespace posewire::filter
