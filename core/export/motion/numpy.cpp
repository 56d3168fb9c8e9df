// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_writer.h"
#include "core/export/motion/skeleton.h"
#include "core/log/scratch.h"
#include "core/log/system_memory.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>

namespace posewire::exporting {
namespace {

/// Numbers of arrays are as this computer has them; those of the archive begin with the low byte.
constexpr char kOrder = std::endian::native == std::endian::little ? '<' : '>';

void appendZip(std::size_t size, std::uint64_t value, std::string& bytes) {
    for (std::size_t i = 0; i < size; ++i, value >>= 8) {
        bytes += static_cast<char>(value & 0xff);
    }
}

/// The CRC-32 of zip (ITU-T V.42), eight bytes at a time.
class Crc32 {
public:
    void add(std::string_view bytes) {
        std::size_t i = 0;
        for (; i + 8 <= bytes.size(); i += 8) {
            const std::uint32_t low = m_rest ^ word(bytes, i);
            const std::uint32_t high = word(bytes, i + 4);
            m_rest = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                m_rest ^= kTables[7 - k][low >> (8 * k) & 0xff] ^ kTables[3 - k][high >> (8 * k) & 0xff];
            }
        }
        for (; i < bytes.size(); ++i) {
            m_rest = m_rest >> 8 ^ kTables[0][(m_rest ^ static_cast<std::uint8_t>(bytes[i])) & 0xff];
        }
    }
    [[nodiscard]] std::uint32_t value() const { return ~m_rest; }

private:
    using Tables = std::array<std::array<std::uint32_t, 256>, 8>;
    static constexpr Tables kTables = [] {
        constexpr std::uint32_t kPolynomial = 0xedb88320;
        Tables tables{};
        for (std::uint32_t byte = 0; byte < 256; ++byte) {
            std::uint32_t rest = byte;
            for (int bit = 0; bit < 8; ++bit) {
                rest = rest >> 1 ^ ((rest & 1) != 0 ? kPolynomial : 0);
            }
            tables[0][byte] = rest;
        }
        for (std::size_t table = 1; table < 8; ++table) {
            for (std::size_t byte = 0; byte < 256; ++byte) {
                const std::uint32_t rest = tables[table - 1][byte];
                tables[table][byte] = rest >> 8 ^ tables[0][rest & 0xff];
            }
        }
        return tables;
    }();

    static std::uint32_t word(std::string_view bytes, std::size_t at) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            word |= std::uint32_t{static_cast<std::uint8_t>(bytes[at + k])} << (8 * k);
        }
        return word;
    }

    std::uint32_t m_rest = ~std::uint32_t{0};
};

/// An array in the format of numpy (NEP 1, version 1.0), kept in scratch memory until the file ends.
class NumpyArray {
public:
    /// `type` as numpy writes it, without the order of bytes; `shape` behind the number of rows: ", 23, 3".
    NumpyArray(std::string name, std::string type, std::string shape, log::Scratch& scratch)
        : m_name(std::move(name)), m_type(std::move(type)), m_shape(std::move(shape)), m_scratch(&scratch) {}

    template <class Number>
    void addRow(std::span<const Number> row) {
        ++m_rows;
        auto bytes = std::as_bytes(row);
        while (!bytes.empty()) {
            if (m_used == kPiece) {
                m_pieces.push_back(m_scratch->bytes(kPiece));
                m_used = 0;
            }
            const std::size_t count = std::min(bytes.size(), kPiece - m_used);
            std::memcpy(m_pieces.back().get() + m_used, bytes.data(), count);
            m_used += count;
            bytes = bytes.subspan(count);
        }
    }
    template <class Number>
    void add(Number number) {
        addRow(std::span<const Number>(&number, 1));
    }
    /// A row for each text of ASCII, which `type` has room for.
    void addTexts(std::span<const std::string_view> texts, std::size_t room) {
        for (const std::string_view text : texts) {
            std::vector<char32_t> letters(room);
            std::ranges::copy(text, letters.begin());
            addRow(std::span<const char32_t>(letters));
        }
    }

    [[nodiscard]] std::string fileName() const { return m_name + ".npy"; }
    /// Returns the header of its file.
    [[nodiscard]] std::string head() const {
        constexpr std::size_t kAlignment = 64;
        constexpr std::size_t kBefore = 10;
        std::string text = std::string("{'descr': '") + (m_type == "u1" ? '|' : kOrder) + m_type +
                           "', 'fortran_order': False, 'shape': (" + std::to_string(m_rows) +
                           (m_shape.empty() ? "," : m_shape) + "), }";
        const std::size_t size = kBefore + text.size() + 1;
        text.append((kAlignment - size % kAlignment) % kAlignment, ' ');
        text += '\n';
        std::string bytes("\x93NUMPY\x01", 7);
        bytes += '\0';
        appendZip(2, text.size(), bytes);
        return bytes + text;
    }
    /// Hands out all values, piece by piece. Each leaves memory afterwards, if it is in a file.
    void forEachPiece(auto&& take) const {
        for (std::size_t i = 0; i < m_pieces.size(); ++i) {
            take(std::string_view(reinterpret_cast<const char*>(m_pieces[i].get()),
                                  i + 1 == m_pieces.size() ? m_used : kPiece));
            if (m_scratch->hasFile()) {
                log::letGo(m_pieces[i].get(), kPiece);
            }
        }
    }

private:
    static constexpr std::size_t kPiece = std::size_t{256} << 10;

    std::string m_name;
    std::string m_type;
    std::string m_shape;
    log::Scratch* m_scratch;
    std::vector<std::shared_ptr<std::byte[]>> m_pieces; ///< all but the last are full
    std::size_t m_used = kPiece;                        ///< of the last
    std::uint64_t m_rows = 0;
};

/// A zip archive of files that are stored as they are, with the sizes of ZIP64 (PKWARE APPNOTE 6.3.3, 4.3).
class ZipArchive {
public:
    explicit ZipArchive(MotionOutput& out) : m_out(out) {}

    void add(const NumpyArray& array) {
        const std::string head = array.head();
        Crc32 crc;
        std::uint64_t size = head.size();
        crc.add(head);
        array.forEachPiece([&](std::string_view piece) {
            crc.add(piece);
            size += piece.size();
        });
        const std::string name = array.fileName();
        m_directory += std::string("PK\x01\x02-\0", 6) + entry(name, crc.value(), 28);
        appendZip(10, 0, m_directory); // no comment, the first disk, no attributes
        appendZip(4, kIn64, m_directory);
        m_directory += name + sizes(size, 24);
        appendZip(8, m_written, m_directory);
        ++m_count;
        write("PK\x03\x04" + entry(name, crc.value(), 20) + name + sizes(size, 16));
        write(head);
        array.forEachPiece([this](std::string_view piece) { write(piece); });
    }

    void finish() {
        const std::uint64_t begin = m_written;
        const std::uint64_t size = m_directory.size();
        write(m_directory);
        std::string end("PK\x06\x06", 4);
        appendZip(8, 44, end);
        appendZip(2, kVersion, end);
        appendZip(2, kVersion, end);
        appendZip(8, 0, end); // disks
        for (const std::uint64_t value : {m_count, m_count, size, begin}) {
            appendZip(8, value, end);
        }
        end += std::string("PK\x06\x07\0\0\0\0", 8);
        appendZip(8, begin + size, end);
        appendZip(4, 1, end);
        end += std::string("PK\x05\x06\0\0\0\0", 8);
        appendZip(2, m_count, end);
        appendZip(2, m_count, end);
        appendZip(4, kIn64, end);
        appendZip(4, kIn64, end);
        appendZip(2, 0, end);
        write(end);
    }

private:
    static constexpr std::uint64_t kVersion = 45; ///< that ZIP64 came with
    static constexpr std::uint64_t kIn64 = 0xffffffff;

    /// Returns the part that a file's own header and the directory share.
    static std::string entry(const std::string& name, std::uint32_t crc, std::size_t extra) {
        constexpr std::uint64_t kFirstDay = 0x21; // of 1980: the same motion makes the same bytes
        std::string bytes;
        appendZip(2, kVersion, bytes);
        appendZip(6, 0, bytes); // no flags, stored, at midnight
        appendZip(2, kFirstDay, bytes);
        appendZip(4, crc, bytes);
        appendZip(4, kIn64, bytes);
        appendZip(4, kIn64, bytes);
        appendZip(2, name.size(), bytes);
        appendZip(2, extra, bytes);
        return bytes;
    }
    /// Returns an extra field of ZIP64 of a length, filled with sizes alone.
    static std::string sizes(std::uint64_t size, std::size_t field) {
        std::string bytes("\x01\0", 2);
        appendZip(2, field, bytes);
        appendZip(8, size, bytes);
        appendZip(8, size, bytes);
        return bytes;
    }
    void write(std::string_view bytes) {
        m_out.write(bytes);
        m_written += bytes.size();
    }

    MotionOutput& m_out;
    std::string m_directory;
    std::uint64_t m_written = 0;
    std::uint64_t m_count = 0;
};

std::shared_ptr<log::Scratch> temporaryScratch() {
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    return error ? std::make_shared<log::Scratch>() : log::scratchOfFile(folder);
}

class NumpyWriter final : public MotionWriter {
public:
    explicit NumpyWriter(const MotionTask& task)
        : m_task(task), m_layout(task.surveyAt(task.characters.front()).layout) {}

    void add(const MotionFrame& frame, MotionOutput&) override {
        m_time.add(frame.seconds);
        m_sample.add(frame.sample);
        m_run.add(static_cast<std::uint32_t>(frame.run));
        const bool hasReceipt = !frame.isGap() && m_task.characterAt(frame.character).hasReceipt;
        m_received.add(hasReceipt ? static_cast<std::int64_t>(log::nanosecondsOf(
                                        m_task.source.log->timeline().wallOf(frame.pose->stamp)))
                                  : kMissing);
        m_timeCode.add(frame.isGap() ? kMissing : std::int64_t{frame.pose->timeCode});
        m_type.add(frame.isGap() ? std::uint8_t{0} : frame.pose->type);
        m_positions.assign(3 * m_segments, std::numeric_limits<float>::quiet_NaN());
        m_orientations.assign(4 * m_segments, std::numeric_limits<float>::quiet_NaN());
        m_sources.assign(m_segments, 0);
        for (std::size_t i = 0; !frame.isGap() && i < m_segments; ++i) {
            addSegment(*frame.pose, i);
        }
        m_position.addRow(std::span<const float>(m_positions));
        m_orientation.addRow(std::span<const float>(m_orientations));
        m_provenance.addRow(std::span<const std::uint8_t>(m_sources));
    }

    void finish(MotionOutput& out) override {
        std::vector<std::string_view> names;
        for (std::size_t i = 0; i < m_segments; ++i) {
            names.push_back(model::segmentName(m_layout, static_cast<int>(i)));
        }
        m_names.addTexts(names, kLongestName);
        m_provenanceNames.addTexts(kProvenanceNames, kLongestName);
        ZipArchive archive(out);
        for (const NumpyArray* array :
             {&m_time, &m_position, &m_orientation, &m_provenance, &m_names, &m_provenanceNames, &m_sample,
              &m_run, &m_timeCode, &m_received, &m_type}) {
            archive.add(*array);
        }
        archive.finish();
    }

private:
    static constexpr std::int64_t kMissing = -1;
    static constexpr std::size_t kLongestName = 16;

    void addSegment(const model::CharacterPose& pose, std::size_t column) {
        const model::SegmentPose* segment = poseAt(pose, m_layout, static_cast<int>(column));
        if (segment == nullptr) {
            return;
        }
        const Eigen::Vector3f at = segment->position.cast<float>();
        const Eigen::Quaternionf turn = segment->orientation.cast<float>();
        std::ranges::copy(std::array{at.x(), at.y(), at.z()}, &m_positions[3 * column]);
        std::ranges::copy(std::array{turn.w(), turn.x(), turn.y(), turn.z()}, &m_orientations[4 * column]);
        m_sources[column] = static_cast<std::uint8_t>(provenanceAt(pose, m_layout, static_cast<int>(column)));
    }
    NumpyArray array(std::string name, std::string type, std::string shape = {}) const {
        return {std::move(name), std::move(type), std::move(shape), *m_scratch};
    }

    const MotionTask& m_task;
    model::SegmentLayout m_layout;
    std::size_t m_segments = static_cast<std::size_t>(m_layout.count());
    std::shared_ptr<log::Scratch> m_scratch = temporaryScratch();
    std::string m_columns = ", " + std::to_string(m_segments);
    NumpyArray m_time = array("time", "f8");
    NumpyArray m_position = array("position", "f4", m_columns + ", 3");
    NumpyArray m_orientation = array("orientation", "f4", m_columns + ", 4");
    NumpyArray m_provenance = array("provenance", "u1", m_columns);
    NumpyArray m_names = array("names", "U16");
    NumpyArray m_provenanceNames = array("provenance_names", "U16");
    NumpyArray m_sample = array("sample", "u4");
    NumpyArray m_run = array("run", "u4");
    NumpyArray m_timeCode = array("time_code_ms", "i8");
    NumpyArray m_received = array("received_ns", "i8");
    NumpyArray m_type = array("type", "u1");
    std::vector<float> m_positions; ///< of a frame
    std::vector<float> m_orientations;
    std::vector<std::uint8_t> m_sources;
};

} // namespace

std::unique_ptr<MotionWriter> makeNumpy(const MotionTask& task) {
    return std::make_unique<NumpyWriter>(task);
}

} // namespace posewire::exporting
