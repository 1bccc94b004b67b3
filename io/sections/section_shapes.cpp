// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/sections/section_shapes.hpp>

#ifdef TERRANE_HAS_SHAPELIB
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <shapefil.h>

#include <terrane/io/text/names.hpp>
#endif

namespace terrane {

#ifdef TERRANE_HAS_SHAPELIB

namespace {

/// The files that shapelib writes, by extension, in memory. No exception may pass through it.
struct ShapeFiles {
    std::map<std::string, std::string, std::less<>> bytes;
    bool lacks_memory = false;
};

struct OpenShapeFile {
    ShapeFiles* all;
    std::string* bytes;
    std::size_t at = 0;
};

/// Returns the open file; shapelib 1.5 passes null where the file of the code page could not be opened.
OpenShapeFile* opened(SAFile file) {
    return reinterpret_cast<OpenShapeFile*>(file);
}

/// Opens a file by its name, which is the address of ShapeFiles and an extension.
SAFile open_to_write(const char* name, const char* access) {
    const std::string_view text(name);
    const auto dot = text.find('.');
    std::uintptr_t address = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), address);
    if (code != std::errc() || dot == std::string_view::npos || end != text.data() + dot)
        return nullptr;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): shapelib 1.5 passes nothing but the name
    auto& files = *reinterpret_cast<ShapeFiles*>(address);
    const std::string_view extension = text.substr(dot);
    try {
        const auto found = files.bytes.find(extension);
        if (access[0] == 'r' && found == files.bytes.end()) return nullptr;
        std::string& bytes =
            found != files.bytes.end() ? found->second : files.bytes[std::string(extension)];
        if (access[0] == 'w') bytes.clear();
        return reinterpret_cast<SAFile>(
            std::make_unique<OpenShapeFile>(OpenShapeFile{&files, &bytes}).release());
    } catch (const std::bad_alloc&) {
        files.lacks_memory = true;
        return nullptr;
    }
}

SAOffset read_back(void* to, SAOffset size, SAOffset count, SAFile file) {
    OpenShapeFile* const open = opened(file);
    if (open == nullptr || size == 0) return 0;
    const std::size_t left = open->bytes->size() - std::min(open->at, open->bytes->size());
    const std::size_t done = std::min<std::size_t>(count, left / size);
    if (done > 0) std::memcpy(to, open->bytes->data() + open->at, done * size);
    open->at += done * size;
    return done;
}

SAOffset write_bytes(const void* from, SAOffset size, SAOffset count, SAFile file) {
    OpenShapeFile* const open = opened(file);
    if (open == nullptr) return 0;
    try {
        open->bytes->resize(std::max<std::size_t>(open->bytes->size(), open->at + size * count));
    } catch (const std::bad_alloc&) {
        open->all->lacks_memory = true;
        return 0;
    }
    if (size * count > 0) std::memcpy(open->bytes->data() + open->at, from, size * count);
    open->at += size * count;
    return count;
}

SAOffset seek_bytes(SAFile file, SAOffset offset, int whence) {
    OpenShapeFile* const open = opened(file);
    if (open == nullptr) return 1;
    open->at = offset + (whence == SEEK_CUR   ? open->at
                         : whence == SEEK_END ? open->bytes->size()
                                              : 0);
    return 0;
}

int close_bytes(SAFile file) {
    const std::unique_ptr<OpenShapeFile> open(reinterpret_cast<OpenShapeFile*>(file));
    return 0;
}

// Version 1.6 of shapelib passes a pointer as well; the assignments below choose what fits.
[[maybe_unused]] SAFile open_to_write(const char* name, const char* access, void*) {
    return open_to_write(name, access);
}
[[maybe_unused]] SAOffset write_bytes(void* from, SAOffset size, SAOffset count, SAFile file) {
    return write_bytes(static_cast<const void*>(from), size, count, file);
}
[[maybe_unused]] int remove_nothing(const char*) {
    return 0;
}
[[maybe_unused]] int remove_nothing(const char*, void*) {
    return 0;
}

SAHooks hooks_that_write() {
    SAHooks hooks{};
    hooks.FOpen = open_to_write;
    hooks.FRead = read_back;
    hooks.FWrite = write_bytes;
    hooks.FSeek = seek_bytes;
    hooks.FTell = [](SAFile file) -> SAOffset { return file == nullptr ? 0 : opened(file)->at; };
    hooks.FFlush = [](SAFile) { return 0; };
    hooks.FClose = close_bytes;
    hooks.Remove = remove_nothing;
    hooks.Error = [](const char*) {};
    hooks.Atof = [](const char*) { return 0.0; };
    return hooks;
}

struct EndShapes {
    void operator()(SHPHandle file) const { SHPClose(file); }
    void operator()(DBFHandle file) const { DBFClose(file); }
    void operator()(SHPObject* object) const { SHPDestroyObject(object); }
};

/// One shapefile and its table.
class Shapes {
public:
    static constexpr int most_bytes = 254; ///< of a text in a table

    /// map: coordinates are x, y and z.
    Shapes(const Section& section, bool polygons, bool map) : section_(section), map_(map) {
        type_ = polygons ? (map ? SHPT_POLYGONZ : SHPT_POLYGON) : (map ? SHPT_ARCZ : SHPT_ARC);
        const auto name = fmt::format("{}", reinterpret_cast<std::uintptr_t>(&files_));
        SAHooks hooks = hooks_that_write();
        shapes_.reset(SHPCreateLL(name.c_str(), type_, &hooks));
        table_.reset(DBFCreateLL(name.c_str(), "UTF-8", &hooks));
        if (!shapes_ || !table_) throw std::bad_alloc();
    }

    void add_text_field(const char* name) {
        if (DBFAddField(table_.get(), name, FTString, most_bytes, 0) < 0) throw std::bad_alloc();
    }
    void add_number_field(const char* name) {
        if (DBFAddField(table_.get(), name, FTDouble, 24, 6) < 0) throw std::bad_alloc();
    }

    void begin() { x_.clear(), y_.clear(), z_.clear(), parts_.clear(); }
    template <class Vertices>
    void add_part(const Vertices& vertices) {
        parts_.push_back(static_cast<int>(x_.size()));
        for (const std::uint32_t v : vertices) {
            x_.push_back(section_.flat[v][0]);
            y_.push_back(section_.flat[v][1]);
            z_.push_back(section_.vertices[v].z);
        }
    }
    /// Writes the parts as one shape; values of its fields follow.
    void end() {
        const std::unique_ptr<SHPObject, EndShapes> object(
            SHPCreateObject(type_, -1, static_cast<int>(parts_.size()), parts_.data(), nullptr,
                            static_cast<int>(x_.size()), x_.data(), y_.data(),
                            map_ ? z_.data() : nullptr, nullptr));
        if (!object) throw std::bad_alloc();
        record_ = SHPWriteObject(shapes_.get(), -1, object.get());
        if (record_ < 0) throw std::bad_alloc();
        field_ = 0;
    }
    void add(std::string text) {
        text.resize(std::min<std::size_t>(text.size(), most_bytes));
        if (DBFWriteStringAttribute(table_.get(), record_, field_++, text.c_str()) == 0)
            throw std::bad_alloc();
    }
    /// shapelib itself would write decimal commas where the locale has them.
    void add(double number) {
        std::string text = fmt::format("{:24.6f}", number);
        if (text.size() > 24) text = fmt::format("{:24.15e}", number);
        if (DBFWriteAttributeDirectly(table_.get(), record_, field_++, text.data()) == 0)
            throw std::bad_alloc();
    }

    /// Appends the files.
    void append_to(std::vector<SectionFile>& all, const std::string& ending) {
        shapes_.reset();
        table_.reset();
        if (files_.lacks_memory) throw std::bad_alloc();
        for (const char* extension : {".shp", ".shx", ".dbf", ".cpg"})
            all.push_back({ending + extension, std::move(files_.bytes[extension])});
    }

private:
    const Section& section_;
    bool map_;
    int type_, record_ = 0, field_ = 0;
    ShapeFiles files_;
    std::unique_ptr<SHPInfo, EndShapes> shapes_;
    std::unique_ptr<DBFInfo, EndShapes> table_;
    std::vector<double> x_, y_, z_;
    std::vector<int> parts_;
};

void append_polygons(const Section& section, const SectionNames& names,
                     std::vector<SectionFile>& all) {
    Shapes shapes(section, true, is_map(section));
    for (const char* name : {"BLOCK", "BEHIND", "UNIT"}) shapes.add_text_field(name);
    shapes.add_number_field("AREA");
    for (const SectionPolygon& polygon : section.polygons) {
        shapes.begin();
        for (std::vector<std::uint32_t> ring : polygon.rings) {
            std::reverse(ring.begin(), ring.end()); // outer rings are clockwise there
            ring.push_back(ring.front());
            shapes.add_part(ring);
        }
        shapes.end();
        shapes.add(names.blocks[polygon.block]);
        shapes.add(names.blocks[polygon.behind]);
        shapes.add(names.units[names.shown(polygon)]);
        shapes.add(polygon.area);
    }
    shapes.append_to(all, "");
}

void append_lines(const Section& section, const SectionNames& names,
                  std::vector<SectionFile>& all) {
    Shapes shapes(section, false, is_map(section));
    for (const char* name : {"SURFACE", "ROLE"}) shapes.add_text_field(name);
    for (const SectionLine& line : section.lines) {
        shapes.begin();
        shapes.add_part(line.vertices);
        shapes.end();
        const SurfaceInfo& surface = names.surfaces[line.surface];
        shapes.add(surface.name);
        shapes.add(std::string(detail::role_names[static_cast<std::size_t>(surface.role)]));
    }
    shapes.append_to(all, "_lines");
}

} // namespace

Result<std::vector<SectionFile>> section_shapes(const Section& section, const SectionNames& names) {
    std::vector<SectionFile> all;
    append_polygons(section, names, all);
    append_lines(section, names, all);
    return all;
}

#else

Result<std::vector<SectionFile>> section_shapes(const Section&, const SectionNames&) {
    return Error{ErrorCode::unsupported,
                 "this build cannot write shapefiles, as shapelib (libshp-dev) was not there when "
                 "it was made",
                 ""};
}

#endif

} // namespace terrane
