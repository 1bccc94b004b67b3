// SPDX-License-Identifier: LGPL-3.0-or-later
#include "forge_lists.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include <gmpxx.h>

#include <terrane/algorithms/core/no_index.hpp>

namespace terrane::fuzz {

void change_number(std::uint32_t& number, const Arguments& n) {
    switch (n.c % 4) {
    case 0:
        number = n.d % 64;
        break;
    case 1:
        ++number;
        break;
    case 2:
        --number;
        break;
    default:
        number = n.d % 2 == 0 ? no_index : number ^ 1U;
    }
}

namespace {

// --- Lists --------------------------------------------------------------------------------------

template <std::size_t count>
void change_item(std::array<std::uint32_t, count>& item, const Arguments& n) {
    if (n.b % 4 == 0)
        std::swap(item[n.c % count], item[n.d % count]);
    else if (n.b % 4 == 1)
        std::rotate(item.begin(), item.begin() + 1, item.end());
    else
        change_number(item[n.b / 4 % count], n);
}

void change_item(std::uint32_t& item, const Arguments& n) {
    change_number(item, n);
}

void change_item(double& item, const Arguments& n) {
    item = n.b % 2 == 0 ? moved(item, n.c, n.d) : item * (n.c + 1.0) / 16;
}

void change_item(std::array<double, 2>& item, const Arguments& n) {
    change_item(item[n.b / 2 % 2], n);
}

void change_item(CertifiedLayer& item, const Arguments& n) {
    if (n.b % 2 == 0)
        change_number(item.surface, n);
    else
        change_item(item.hardness, n);
}

void change_item(Point3& item, const Arguments& n) {
    double& x = n.b % 3 == 0 ? item.x : n.b % 3 == 1 ? item.y : item.z;
    x = moved(x, n.c, n.d);
}

/// Changes a fraction, in value or in form.
void change_item(std::string& item, const Arguments& n) {
    mpq_class value;
    if (value.set_str(item, 10) != 0 || value.get_den() == 0) return;
    switch (n.b % 5) {
    case 0:
        value += mpq_class(1, 1 + n.c);
        break;
    case 1:
        value = -value;
        break;
    case 2:
        value *= mpq_class(n.c + 1, 16);
        break;
    case 3:
        item = mpz_class(value.get_num() * 2).get_str() + "/" +
               mpz_class(value.get_den() * 2).get_str();
        return;
    default:
        item = (n.c % 2 == 0 ? "+" : "0") + item;
        return;
    }
    value.canonicalize();
    item = value.get_str();
}

void change_item(Surface& item, const Arguments& n) {
    if (n.b % 2 == 0 && !item.vertices.empty())
        change_item(item.vertices[pick(n.a, item.vertices.size())], n);
    else if (!item.triangles.empty())
        change_item(item.triangles[pick(n.a, item.triangles.size())], n);
}

void change_item(std::array<Point3, 3>& item, const Arguments& n) {
    if (n.b % 4 == 3)
        std::swap(item[n.c % 3], item[n.d % 3]);
    else
        change_item(item[n.b / 4 % 3], n);
}

void change_item(SealedPart& item, const Arguments& n) {
    auto& list = n.a % 2 == 0 ? item.sealed : item.extended;
    if (n.b % 8 == 7)
        std::swap(item.sealed, item.extended);
    else if (n.b % 8 == 6 || list.empty())
        change_item(item.limit, n);
    else
        change_item(list[pick(n.a / 2, list.size())], n);
}

void change_item(Construction& item, const Arguments& n) {
    change_number(item.v[n.b % 9], n);
}

void change_item(FilledPart& item, const Arguments& n) {
    if (n.b % 3 == 0)
        change_number(item.vertices, n);
    else if (n.b % 3 == 1)
        change_number(item.triangles, n);
    else
        item.limit = item.limit * (n.c + 1.0) / 16 + (n.d % 4 == 0 ? 1e-3 * n.d : 0);
}

void change_item(Numbers& item, const Arguments& n) {
    if (n.b % 3 == 0 && !item.empty())
        item.erase(item.begin() + static_cast<std::ptrdiff_t>(pick(n.c, item.size())));
    else if (n.b % 3 == 1)
        item.insert(std::ranges::upper_bound(item, n.d % 64), n.d % 64);
    else if (!item.empty())
        change_number(item[pick(n.d, item.size())], n);
}

/// One of several lists that are parallel to each other.
struct Column {
    std::function<std::size_t()> size;
    std::function<void(std::size_t)> drop, repeat;
    std::function<void(std::size_t, std::size_t)> exchange;
    std::function<void(std::size_t, const Arguments&)> change;
};

template <class Item>
Column column(std::vector<Item>& items) {
    return {[&] { return items.size(); }, [&](std::size_t i) { erase_at(items, i); },
            [&](std::size_t i) {
                const Item item = items[i];
                items.push_back(item);
            },
            [&](std::size_t i, std::size_t j) { std::swap(items[i], items[j]); },
            [&](std::size_t i, const Arguments& n) { change_item(items[i], n); }};
}

Column column(IndexLists<std::uint32_t>& lists) {
    const auto edited = [&lists](const auto& edit) {
        auto all = unpacked(lists);
        edit(all);
        lists = packed(all);
    };
    return {[&] { return lists.size(); }, [&](std::size_t i) { erase_at(lists, i); },
            [=](std::size_t i) { edited([&](auto& all) { all.push_back(Numbers(all[i])); }); },
            [=](std::size_t i, std::size_t j) {
                edited([&](auto& all) { std::swap(all[i], all[j]); });
            },
            [=](std::size_t i, const Arguments& n) {
                edited([&](auto& all) { change_item(all[i], n); });
            }};
}

/// Lists that are parallel to each other, with their name.
struct Table {
    const char* name;
    std::vector<Column> columns;
};

void add_arrangement(Certificate& c, std::vector<Table>& tables) {
    ArrangementClaim& e = c.exact;
    tables.push_back({"exact vertices", {column(e.vertices)}});
    tables.push_back({"exact triangles", {column(e.triangles), column(e.parents_of)}});
    tables.push_back({"exact intersection edges", {column(e.intersection_edges)}});
    tables.push_back({"degenerate", {column(e.degenerate)}});
    tables.push_back({"duplicates", {column(e.duplicates)}});
    if (!c.rounded) return;
    RoundedClaim& r = *c.rounded;
    tables.push_back({"vertices", {column(r.vertices)}});
    tables.push_back(
        {"triangles", {column(r.triangles), column(r.parents_of), column(r.regions_of)}});
    tables.push_back({"intersection edges", {column(r.intersection_edges)}});
    tables.push_back({"vanished", {column(r.vanished)}});
}

void add_blocks(BlocksClaim& b, std::vector<Table>& tables) {
    tables.push_back({"shells", {column(b.shells), column(b.block_of_shell), column(b.around)}});
    tables.push_back({"volumes", {column(b.volumes)}});
    tables.push_back({"block names", {column(b.names)}});
}

void add_tetrahedra(TetrahedraClaim& t, std::vector<Table>& tables) {
    tables.push_back({"nodes", {column(t.vertices)}});
    tables.push_back({"tetrahedra", {column(t.tetrahedra), column(t.block_of)}});
    tables.push_back({"faces", {column(t.faces), column(t.triangle_of)}});
    tables.push_back({"twins", {column(t.twins)}});
}

void add_cut(CutClaim& c, std::vector<Table>& tables) {
    tables.push_back({"dropped", {column(c.dropped)}});
    tables.push_back({"corners", {column(c.volume.corners)}});
    tables.push_back({"heights", {column(c.volume.between)}});
    tables.push_back({"sides", {column(c.volume.boundary)}});
}

void add_layered(LayeredClaim& m, std::vector<Table>& tables) {
    tables.push_back({"layers", {column(m.order)}});
    tables.push_back({"layered vertices", {column(m.vertices)}});
    std::vector<Column> columns{column(m.triangles), column(m.surfaces_of)};
    if (m.regions_of.size() != 0) columns.push_back(column(m.regions_of));
    if (m.parents_of.size() != 0) columns.push_back(column(m.parents_of));
    tables.push_back({"layered triangles", std::move(columns)});
}

/// Returns the lists of a certificate, those of its kind first.
std::vector<Table> tables_of(Certificate& c) {
    std::vector<Table> tables;
    if (c.tetrahedra()) add_tetrahedra(*c.tetrahedra(), tables);
    if (c.blocks()) add_blocks(*c.blocks(), tables);
    if (c.improved()) {
        ImprovedClaim& m = *c.improved();
        tables.push_back({"improved vertices", {column(m.vertices)}});
        tables.push_back({"improved triangles",
                          {column(m.triangles), column(m.surfaces_of), column(m.regions_of)}});
        tables.push_back({"improved intersection edges", {column(m.intersection_edges)}});
        tables.push_back({"limits", {column(m.limits)}});
    }
    if (c.cut) add_cut(*c.cut, tables);
    if (c.sealed) {
        tables.push_back({"sealed parts", {column(c.sealed->surfaces)}});
        for (SealedPart& part : c.sealed->surfaces) {
            tables.push_back({"extended triangles", {column(part.extended)}});
            tables.push_back({"sealing triangles", {column(part.sealed)}});
        }
    }
    if (c.layered()) {
        add_layered(*c.layered(), tables);
    } else if (c.filled()) {
        tables.push_back({"filled vertices", {column(c.filled()->vertices)}});
        tables.push_back({"filled triangles", {column(c.filled()->triangles)}});
        tables.push_back({"filled surfaces", {column(c.filled()->surfaces)}});
    } else {
        add_arrangement(c, tables);
    }
    return tables;
}

} // namespace

std::string change_list(Certificate& certificate, unsigned which, const Arguments& n) {
    auto tables = tables_of(certificate);
    Table& table = tables[which % tables.size()];
    auto& columns = table.columns;
    // The argument b also chooses what of an item is changed.
    const unsigned how = which / static_cast<unsigned>(tables.size()) % 6;
    Column& one = columns[n.d % columns.size()];
    const std::size_t size = one.size();
    if (size == 0) return "nothing";
    const auto each = [&](const auto& act) { // of the lists that are still parallel
        for (Column& other : columns)
            if (other.size() == size) act(other);
    };
    const std::size_t i = pick(n.a, size), j = pick(n.c, size);
    switch (how) {
    case 0:
        each([&](Column& c) { c.drop(i); });
        break;
    case 1:
        each([&](Column& c) { c.repeat(i); });
        break;
    case 2:
        each([&](Column& c) { c.exchange(i, j); });
        break;
    case 3:
        one.exchange(i, j);
        break;
    case 4:
        each([&](Column& c) {
            for (std::size_t k = size; k-- > (n.b % 2 == 0 ? 0 : i);) c.drop(k);
        });
        break;
    default:
        one.change(i, n);
    }
    static constexpr std::array names{"dropped",         "repeated",  "exchanged",
                                      "exchanged alone", "cut short", "number changed"};
    return std::string(table.name) + ": " + names[how];
}

// --- Output files -------------------------------------------------------------------------------

std::string change_files(Certificate& certificate, Contents& contents, const Arguments& n) {
    auto& outputs = certificate.outputs;
    if (outputs.empty() || outputs.size() != contents.size()) return "nothing";
    const std::size_t i = pick(n.a, outputs.size()), j = pick(n.c, outputs.size());
    switch (n.b % 6) {
    case 0:
        erase_at(outputs, i);
        erase_at(contents, i);
        return "output dropped";
    case 1:
        std::swap(contents[i], contents[j]);
        return "output files exchanged";
    case 2:
        std::swap(outputs[i].name, outputs[j].name);
        return "names of outputs exchanged";
    case 3: {
        const CertifiedOutput again = outputs[i];
        const std::string same = contents[i];
        outputs.push_back(again);
        contents.push_back(same);
        return "output repeated";
    }
    case 4: {
        // Change a digit, wherever one is.
        std::string& text = contents[i];
        const std::size_t from = text.empty() ? 0 : (n.a * 251U + n.c * 16U + n.d) % text.size();
        const std::size_t at = text.find_first_of("0123456789", from);
        if (at == std::string::npos) return "nothing";
        text[at] = static_cast<char>('0' + (text[at] - '0' + 1 + n.d % 9) % 10);
        return "digit of an output changed";
    }
    default: {
        std::string& text = contents[i];
        if (text.empty()) return "nothing";
        char& byte = text[(n.a * 251U + n.c * 16U + n.d) % text.size()];
        byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << n.d % 8));
        return "bit of an output changed";
    }
    }
}

} // namespace terrane::fuzz
