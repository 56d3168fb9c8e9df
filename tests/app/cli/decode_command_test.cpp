// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/wire/codec.h"
#include "tests/app/cli/program_run.h"
#include "tests/core/log/capture_fixture.h"
#include "tests/support/golden.h"
#include "tests/support/hostile_text.h"
#include "tests/support/paths.h"

#include <QProcess>

#include <gmock/gmock.h>

namespace posewire::cli::test {
namespace {

using posewire::test::golden;
using posewire::test::goldens;
using testing::HasSubstr;
using testing::StartsWith;

TEST(DecodeCommand, WritesEveryGoldenWordForWord) {
    for (const auto& golden : goldens()) {
        const ProgramRun run = runProgram({"decode", "--json", fileWith(asText(golden.bytes))});
        EXPECT_EQ(run.status, 0) << golden.name << run.err;
        EXPECT_EQ(run.out, textOfFile(posewire::test::sourcePath("tests/golden/" + golden.name + ".json")));
    }
}

TEST(DecodeCommand, ReadsStandardInput) {
    const auto& bytes = golden("24_centre_36_counted").bytes;
    const ProgramRun run = runProgram({"decode", "--json", "-"}, asText(bytes));
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out, textOfFile(posewire::test::sourcePath("tests/golden/24_centre_36_counted.json")));
}

TEST(DecodeCommand, CountsObjectsAndBytesThroughTheFile) {
    const std::string file = asText(golden("24_centre_12_counted").bytes) +
                             asText(golden("25_time_code_counted").bytes) +
                             asText(golden("24_centre_12_counted").bytes);
    const ProgramRun run = runProgram({"decode", "--json", fileWith(file)});
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.out, StartsWith(R"({"index":0,"offset":0,"size":36,)"));
    EXPECT_THAT(run.out, HasSubstr("\n"
                                   R"({"index":1,"offset":36,"size":40,)"));
    EXPECT_THAT(run.out, HasSubstr("\n"
                                   R"({"index":2,"offset":76,"size":36,)"));
}

TEST(DecodeCommand, WritesTheFieldsThatAreAskedForInTheirOrder) {
    const std::string file =
        asText(golden("25_time_code_counted").bytes) + "xxx" + asText(golden("24_centre_12_counted").bytes);
    const ProgramRun all = runProgram({"decode", "--json", "-"}, file);
    const ProgramRun run =
        runProgram({"decode", "--fields", "body.timeCode,sample,index,skipped,body,type", "-"}, file);
    const auto valueOf = [lines = all.out](const std::string& key, std::size_t from, const std::string& end) {
        const std::size_t begin = lines.find("\"" + key + "\":", from) + key.size() + 3;
        return lines.substr(begin, lines.find(end, begin) - begin);
    };
    const std::size_t second = all.out.rfind("\n{");
    const std::string code = valueOf("timeCode", all.out.find("\"body\""), "}");
    EXPECT_EQ(run.status, all.status);
    EXPECT_EQ(run.out, R"({"body.timeCode":)" + code + R"(,"sample":)" + valueOf("sample", 0, ",") +
                           R"(,"index":0,"body":{"timeCode":)" + code +
                           R"(},"type":"25"})"
                           "\n"
                           R"({"index":1,"skipped":true})"
                           "\n"
                           R"({"sample":)" +
                           valueOf("sample", second, ",") + R"(,"index":2,"body":)" +
                           valueOf("body", second, ",\"notices\"") +
                           R"(,"type":"24"})"
                           "\n");
}

TEST(DecodeCommand, WritesEachFieldAsItIsAmongAll) {
    const ProgramRun names = runProgram({"decode", "--fields", "nothing", "-"}, "");
    EXPECT_EQ(names.status, 2);
    EXPECT_THAT(names.err,
                HasSubstr(R"(there is no field "nothing"; choose from index, offset, size, stampNs, )"));
    EXPECT_THAT(names.err, HasSubstr(", body.segments"));
    for (const auto& golden : goldens()) {
        const std::string file = asText(golden.bytes);
        const ProgramRun all = runProgram({"decode", "--json", "-"}, file);
        const ProgramRun some = runProgram({"decode", "--fields",
                                            "index,offset,size,stampNs,source,type,sample,datagram,last,"
                                            "items,timeCode,character,bodySegments,props,"
                                            "fingerSegments,payloadSize,error,body,notices,bytes",
                                            "-"},
                                           file);
        EXPECT_EQ(some.out, all.out) << golden.name;
        EXPECT_EQ(some.status, all.status) << golden.name;
    }
}

TEST(DecodeCommand, ShowsBytesThatBelongToNoDatagramAsOneObject) {
    const std::string datagram = asText(golden("24_centre_12_counted").bytes);
    const std::string garbage(200'000, 'x');
    const ProgramRun run = runProgram({"decode", "--json", "-"}, datagram + garbage + datagram);
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.out, HasSubstr("\n"
                                   R"({"index":1,"offset":36,"size":200000,"skipped":true})"
                                   "\n"));
    EXPECT_THAT(run.out, HasSubstr("\n"
                                   R"({"index":2,"offset":200036,"size":36,)"));
    EXPECT_THAT(run.err, HasSubstr("standard input: 200000 bytes belong to no datagram; the output says"));
    EXPECT_THAT(run.err, HasSubstr("standard input: has 2 MXTP datagrams, but"));
}

TEST(DecodeCommand, ShowsADatagramWithAFaultAndEndsWithStatusOne) {
    const auto& whole = golden("24_centre_12_counted").bytes;
    const ProgramRun run = runProgram({"decode", "--json", "-"}, asText({whole.begin(), whole.end() - 1}));
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.out, HasSubstr(R"("payloadSize":12,"error":{"code":"payloadTruncated","offset":35,)"));
    EXPECT_THAT(run.err, HasSubstr("1 of 1 datagrams could not be decoded, the first at byte 0"));
}

TEST(EveryReader, SaysWhatAFileHoldsThatHasNothingOfOurs) {
    const std::string path = fileWith("");
    const std::vector<std::pair<std::vector<std::string>, int>> all{
        {{"decode", path}, 0},
        {{"decode", "--json", path}, 0},
        {{"monitor", "--json", path}, 0},
        {{"report", path, "-o", newPath()}, 0},
        {{"export", path, "-o", newPath(), "--format", "csv"}, 2},
        {{"send", "--to", "127.0.0.1:9", "--file", path}, 1}};
    for (const auto& [arguments, status] : all) {
        const ProgramRun run = runProgram(arguments);
        EXPECT_EQ(run.status, status) << arguments[0];
        EXPECT_THAT(run.err, HasSubstr("is empty; was it copied whole?")) << arguments[0];
    }
}

TEST(DecodeCommand, HasNothingToSayAboutAnEmptyFile) {
    const ProgramRun run = runProgram({"decode", "--json", "-"});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out + run.err, "");
}

TEST(DecodeCommand, GoesOnToTheNextFileWhereOneIsMissing) {
    const std::string good = fileWith(asText(golden("24_centre_12_counted").bytes));
    const ProgramRun run = runProgram({"decode", "--json", "/no/such/file", good});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, textOfFile(posewire::test::sourcePath("tests/golden/24_centre_12_counted.json")));
}

TEST(DecodeCommand, ListsEveryFieldForPeople) {
    const ProgramRun run = runProgram({"decode", fileWith(asText(golden("12_metadata_counted").bytes))});
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.out, StartsWith("#0  offset 0  74 bytes  12 Metadata\n"));
    EXPECT_THAT(run.out, HasSubstr("payloadSize                   50  bytes\n"));
    EXPECT_THAT(run.out, HasSubstr("name:J\u00f6rg: take 2\\nxmid:0080A1B2\\ncolor:e96417\\n"));
}

TEST(DecodeCommand, ListsHostileTextAsSymbols) {
    std::string all;
    for (const std::string& name : posewire::test::hostileNames()) {
        if (name.size() < 256) { // all of a long one is listed: nothing else shows it
            wire::Datagram datagram{{}, wire::MetaData{.text = "name:" + name + '\n'}, {}};
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            all += asText(*wire::encode(datagram));
        }
    }
    const std::string listed = runProgram({"decode", "-"}, all).out;
    EXPECT_EQ(posewire::test::harmIn(listed), "") << listed;
    EXPECT_THAT(listed, HasSubstr("gpj.⟨U+202E⟩exe⟨U+2066⟩"));
    EXPECT_THAT(listed, HasSubstr("␛]0;title␇␛[2J␡⟨U+009B⟩1m␉␍\\n"));
}

TEST(DecodeCommand, ListsFaultsAndNoticesForPeople) {
    const auto& whole = golden("25_time_code_wrong_length").bytes;
    EXPECT_THAT(runProgram({"decode", "-"}, asText(whole)).out,
                HasSubstr("  notice: length before the time code is not 12 (byte 24)\n"));
    EXPECT_THAT(runProgram({"decode", "-"}, asText({whole.begin(), whole.end() - 1})).out,
                HasSubstr("  error: shorter than its header announces (byte 39: needs 40 bytes, has 39)\n"));
}

TEST(DecodeCommand, ReadsPcapAndPcapngByTheirContent) {
    const log::ByteVector frame = log::ethernet(log::ipv4(log::udp(golden("24_centre_12_counted").bytes)));
    const auto pcap = log::pcap({{1700000000, 123456789, frame}}, 0xa1b23c4d, 1, false);
    const auto pcapng = log::joined({log::sectionHeader(false), log::interfaceBlock(1, 9, false),
                                     log::enhancedPacket(0, 1700000000123456789, frame, false)});
    for (const auto& [file, offset] : {std::pair(pcap, 82), std::pair(pcapng, 130)}) {
        const ProgramRun run = runProgram({"decode", "--json", fileWith(asText(file))});
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_THAT(run.out,
                    StartsWith(R"({"index":0,"offset":)" + std::to_string(offset) +
                               R"(,"size":36,"stampNs":1700000000123456789,"source":"10.0.0.2:40001",)"));
        EXPECT_TRUE(runProgram({"encode", "-"}, run.out).out == asText(golden("24_centre_12_counted").bytes));
    }
}

#ifndef _WIN32 // which has no such shell
TEST(DecodeCommand, EndsQuietlyWhenItsReaderHasSeenEnough) {
    std::string many;
    for (int i = 0; i < 2000; ++i) {
        many += asText(golden("02_quaternion_counted").bytes);
    }
    QProcess process;
    process.start(
        "/bin/sh",
        {"-c", QString(POSEWIRE_CLI " decode --json %1 | head -c 10; :").arg(fileWith(many).c_str())});
    ASSERT_TRUE(process.waitForFinished(60000));
    EXPECT_EQ(process.readAllStandardOutput().toStdString(), R"({"index":0)");
    EXPECT_EQ(process.readAllStandardError().toStdString(), "");
}
#endif

TEST(DecodeCommand, ShowsTheRecordedMetadataWordForWord) {
    const auto bytes = posewire::test::capture("mxtp12.bin");
    if (bytes.empty()) {
        GTEST_SKIP() << "NOT TESTED: the recorded datagrams are not at hand";
    }
    EXPECT_EQ(
        runProgram({"decode", "--json", "-"}, asText(bytes)).out,
        R"({"index":0,"offset":0,"size":82,"stampNs":null,"source":null,"type":"12","sample":0,"datagram":0,)"
        R"("last":true,"items":1,"timeCode":0,"character":0,"bodySegments":23,"props":0,"fingerSegments":0,)"
        R"("payloadSize":58,"body":{"tags":[["color","e96417"],["count","1"],["name","Factory"],)"
        R"(["timeOffset","-3600000"]]},"notices":[]})"
        "\n");
}

} // namespace
} // namespace posewire::cli::test
