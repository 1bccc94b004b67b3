// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Files of a folder with blocks that are not what their certificate says, with right hashes: each
// is refuted.
#include "support/forged_blocks.hpp"

#include <cctype>

namespace forged_block_files_test {

using namespace forged;

namespace {

/// Checks that a file that is left out, or there twice, is refuted.
void check_each_is_there_once(const Subject& right) {
    for (std::size_t i = 0; i < right.contents.size(); ++i) {
        INFO(right.certificate["outputs"][i]["name"]);
        Subject s = right;
        s.certificate["outputs"].erase(i);
        s.contents.erase(s.contents.begin() + static_cast<std::ptrdiff_t>(i));
        CHECK(judged(s) == "R21");
        s = right;
        s.certificate["outputs"].push_back(Json(s.certificate["outputs"][i]));
        s.contents.push_back(std::string(s.contents[i]));
        CHECK(judged(s) == "R21");
    }
}

} // namespace

TEST_CASE("forged certificates of blocks: files") {
    const Subject right = block_subject(nested());
    REQUIRE(judged(right) == "");
    const auto output = [&](const std::string& name) {
        for (std::size_t i = 0; i < right.contents.size(); ++i)
            if (right.certificate["outputs"][i]["name"] == "model/" + name) return i;
        FAIL(name);
        return std::size_t(0);
    };
    const auto judged_with = [&](std::size_t i, const std::string& contents) {
        Subject s = right;
        s.contents[i] = contents;
        seal(s);
        return judged(s);
    };
    SECTION("another file of the folder") {
        for (const auto& [name, other] : std::vector<std::pair<std::string, std::string>>{
                 {"blocks/block_1.vtp", "blocks/block_2.vtp"},
                 {"blocks/block_3.vtp", "blocks/block_5.vtp"},
                 {"interfaces/interface_0.vtp", "interfaces/interface_1.vtp"},
                 {"result.vtp", "blocks/block_1.vtp"},
                 {"blocks/block_1.vtp", "result.vtp"},
                 {"model.json", "result.vtp"}}) {
            INFO(name << " holds " << other);
            CHECK(judged_with(output(name), right.contents[output(other)]) == "R21");
        }
    }
    SECTION("a name that says that it is another one") {
        for (const char* name :
             {"model/blocks/block_2.vtp", "model/blocks/block_01.vtp", "model/blocks/block_0.vtp",
              "model/blocks/block_99.vtp", "model/any.vtp", "model/model.json"}) {
            Subject s = right;
            s.certificate["outputs"][output("blocks/block_1.vtp")]["name"] = name;
            CHECK(judged(s) == "R21");
        }
    }
    SECTION("a file left out, there twice, or of another folder") {
        check_each_is_there_once(right);
        for (std::size_t i = 0; i < right.contents.size(); ++i) {
            INFO(right.certificate["outputs"][i]["name"]);
            Subject s = right;
            Json& name = s.certificate["outputs"][i]["name"];
            name = "other/" + name.get<std::string>().substr(6);
            CHECK(judged(s) == "R21");
        }
        Subject s = right;
        s.certificate["outputs"] = Json::array();
        s.contents.clear();
        CHECK(judged(s) == ""); // the certificate is about no file
    }
    SECTION("one number of model.json") {
        const std::string text = right.contents[output("model.json")];
        for (const auto& [old, by] : std::vector<std::pair<std::string, std::string>>{
                 {"\"volume_written\":1.0", "\"volume_written\":1.0000000000000002"},
                 {"\"volumes\":[0,1]", "\"volumes\":[0,2]"},
                 {"\"interfaces\":[", "\"interfaces\":[7,"},
                 {"\"neighbours\":[", "\"neighbours\":[7,"},
                 {"\"triangles\":[[", "\"triangles\":[[1"},
                 {"blocks/block_1.vtp", "blocks/block_2.vtp"},
                 {"\"patches\":[0", "\"patches\":[1"}}) {
            INFO(old);
            const auto at = text.find(old);
            REQUIRE(at != std::string::npos);
            CHECK(judged_with(output("model.json"),
                              std::string(text).replace(at, old.size(), by)) == "R21");
        }
    }
    SECTION("any digit of model.json") {
        // The sheet ends freely, and the bodies have corners.
        const std::size_t model = output("model.json");
        const std::string& text = right.contents[model];
        const auto parsed = parse_certificate(right.certificate.dump(), "c");
        REQUIRE(parsed);
        Certificate certificate = parsed.value();
        OutputVerifier verifier(certificate);
        CHECK(verifier(text, model).violations.empty());
        for (std::size_t at = 0; at < text.size(); ++at) {
            if (!std::isdigit(static_cast<unsigned char>(text[at]))) continue;
            std::string wrong = text;
            wrong[at] = wrong[at] == '9' ? '1' : static_cast<char>(wrong[at] + 1);
            certificate.outputs[model].sha256 = hexadecimal(sha256(wrong));
            INFO(text.substr(text.rfind('\n', at) + 1, 60) << " digit " << at);
            if (verifier(wrong, model).violations.empty()) FAIL_CHECK(at);
        }
    }
    SECTION("any byte of any file") {
        check_each_byte(right);
        check_each_byte(block_subject(nested(), block_folder::together));
        check_each_byte(block_subject({{"c.obj", cube("c", "0", "3")}}, "obj"));
    }
    SECTION("other lists about model.json") {
        check_forgeries(
            right,
            {{"a name less", [](Json& c) { c["blocks"]["names"].erase(1); }, "R30"},
             {"another name", [](Json& c) { c["blocks"]["names"][1] = "salt"; }, "R21"},
             {"a block less", [](Json& c) { c["model"]["blocks"].erase(1); }, "R21"},
             {"a unit", [](Json& c) { c["model"]["blocks"][1]["unit"] = "shale"; }, "R21"},
             {"another volume", [](Json& c) { c["model"]["blocks"][1]["volume"] = "2"; }, "R21"},
             {"no volume", [](Json& c) { c["model"]["blocks"][1]["volume"] = nullptr; }, "R21"},
             {"no gaps", [](Json& c) { c["model"]["gaps"] = Json::array(); }, "R21"},
             {"no leaks", [](Json& c) { c["model"]["leaks"] = Json::array(); }, "R21"},
             {"a seal",
              [](Json& c) {
                  c["model"]["seal"] =
                      Json{{"distance", "1"}, {"rules", nullptr}, {"changes", Json::array()}};
              },
              "R21"}});
    }
    SECTION("any character of a number in OBJ") {
        const Subject obj = block_subject({{"c.obj", cube("c", "0", "3")}}, "obj");
        for (std::size_t i = 0; i < obj.contents.size(); ++i) {
            if (obj.certificate["outputs"][i]["format"] != "obj") continue;
            for (std::size_t k = 0; k < obj.contents[i].size(); ++k) {
                if (!std::isdigit(static_cast<unsigned char>(obj.contents[i][k]))) continue;
                Subject s = obj;
                s.contents[i][k] = s.contents[i][k] == '7' ? '5' : '7';
                seal(s);
                CHECK(judged(s) == "R21");
            }
        }
    }
    SECTION("one bit of a file") {
        for (std::size_t i = 0; i < right.contents.size(); ++i) {
            Subject s = right;
            s.contents[i][s.contents[i].size() / 2] ^= 1; // the hash stays as it was
            CHECK(judged(s) == "R21");
        }
    }
}

TEST_CASE("forged certificates of blocks: all parts in two files") {
    const Subject right = block_subject(nested(), block_folder::together);
    REQUIRE(right.contents.size() == 4);
    REQUIRE(judged(right) == "");
    Subject backwards = right;
    std::reverse(backwards.contents.begin(), backwards.contents.end());
    Json& outputs = backwards.certificate["outputs"];
    std::reverse(outputs.begin(), outputs.end());
    CHECK(judged(backwards) == "");
    std::swap(outputs[0], outputs[1]); // one of the parts comes first, then the other one
    std::swap(backwards.contents[0], backwards.contents[1]);
    CHECK(judged(backwards) == "");
    const auto output = [&](const std::string& name) {
        for (std::size_t i = 0; i < right.contents.size(); ++i)
            if (right.certificate["outputs"][i]["name"] == "model/" + name) return i;
        FAIL(name);
        return std::size_t(0);
    };
    const auto judged_with = [&](const std::string& name, const std::string& contents) {
        Subject s = right;
        s.contents[output(name)] = contents;
        seal(s);
        return judged(s);
    };
    const auto file = [&](const std::string& name) { return right.contents[output(name)]; };
    SECTION("another file, one left out, or one there twice") {
        CHECK(judged_with("blocks.vtp", file("interfaces.vtp")) == "R21");
        CHECK(judged_with("interfaces.vtp", file("blocks.vtp")) == "R21");
        CHECK(judged_with("interfaces.vtp", file("result.vtp")) == "R21");
        check_each_is_there_once(right);
    }
    SECTION("single files that model.json names") {
        auto text = file("model.json");
        const auto at = text.find("blocks.vtp");
        REQUIRE(at != std::string::npos);
        text.replace(at, 10, "blocks/block_1.vtp");
        CHECK(judged_with("model.json", text) == "R21");
    }
    SECTION("blocks that are not those of the mesh") {
        const Modelled m = modelled(nested());
        const auto judged_after = [&](const auto& change) {
            MeshParts parts = block_parts(m.model.mesh, m.model.volumes, m.model.structure);
            change(parts);
            block_folder::FolderFiles files(m.model, block_folder::together);
            return judged_with("blocks.vtp", files.text_of(parts));
        };
        CHECK(judged_after([](MeshParts&) {}) == "");
        CHECK(judged_after([](MeshParts& p) { ++p.part_of[0]; }) == "R21");
        CHECK(judged_after([](MeshParts& p) { ++p.part_of.back(); }) == "R21");
        CHECK(judged_after([](MeshParts& p) {
                  std::swap(p.all.mesh.triangles[5][0], p.all.mesh.triangles[5][1]);
              }) == "R21");
        CHECK(judged_after([](MeshParts& p) {
                  std::swap(p.all.mesh.triangles[0], p.all.mesh.triangles[1]);
                  std::swap(p.all.triangles[0], p.all.triangles[1]);
              }) == "R21");
        CHECK(judged_after([](MeshParts& p) { p.all.mesh.vertices[3].x += 0x1p-40; }) == "R21");
        CHECK(judged_after([](MeshParts& p) { p.all.mesh.surfaces_of.values[2] ^= 1; }) == "R21");
        CHECK(judged_after([](MeshParts& p) { p.all.mesh.surfaces[0].name = "another"; }) == "R21");
    }
}

} // namespace forged_block_files_test
