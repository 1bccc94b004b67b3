// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Arrays of the library as NumPy arrays, and back. Arrays that go to Python are views: read-only, and
// they keep the object alive that owns the memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <terrane/algorithms/core/described.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::python {

namespace py = pybind11;

/// Text of the library as str. Bytes that are no UTF-8 survive (surrogateescape).
py::str to_text(std::string_view text);
/// The same back. Raises TypeError for what is no str.
std::string from_text(py::handle text);
/// The path that open() would take: a str, bytes or os.PathLike without NUL. Raises TypeError and ValueError as it does.
std::filesystem::path to_path(py::handle path);
/// A list of str.
py::list to_texts(const std::vector<std::string>& texts);

/// The scalar and the row length of the elements of an array.
template <class T>
struct Row {
    using Scalar = T;
    static constexpr std::size_t length = 0; ///< 0: elements are scalars
};
template <>
struct Row<Point3> {
    using Scalar = double;
    static constexpr std::size_t length = 3;
};
template <class T, std::size_t n>
struct Row<std::array<T, n>> {
    using Scalar = T;
    static constexpr std::size_t length = n;
};

/// Returns a read-only array of the elements, which `owner` keeps alive.
template <class T>
py::array view(const T* data, std::size_t count, py::handle owner) {
    using Scalar = typename Row<T>::Scalar;
    static_assert(sizeof(T) == sizeof(Scalar) * std::max<std::size_t>(Row<T>::length, 1));
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(count)};
    if constexpr (Row<T>::length > 0) shape.push_back(Row<T>::length);
    static const Scalar nothing{};
    const auto* first = reinterpret_cast<const Scalar*>(data);
    py::array_t<Scalar> array(shape, first != nullptr ? first : &nothing, owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}
template <class T>
py::array view(const std::vector<T>& values, py::handle owner) {
    return view(values.data(), values.size(), owner);
}

/// Moves values into an array that owns them.
template <class T>
py::array owned(std::vector<T> values) {
    auto* kept = new std::vector<T>(std::move(values));
    const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
    return view(*kept, owner);
}

/// Raises ValueError unless the array has this type, and rows of this length; 0: no rows.
void require_rows(const py::array& array, const py::dtype& type, std::size_t length);

/// Copies an array of the very type and shape.
template <class T>
std::vector<T> copied(const py::array& array) {
    using Scalar = typename Row<T>::Scalar;
    require_rows(array, py::dtype::of<Scalar>(), Row<T>::length);
    const auto rows = py::array_t<Scalar, py::array::c_style>::ensure(array);
    if (!rows) throw std::bad_alloc(); // for rows in C order: pybind11 forgets the error
    std::vector<T> copy(static_cast<std::size_t>(rows.shape(0)));
    if (!copy.empty()) std::memcpy(copy.data(), rows.data(), copy.size() * sizeof(T));
    return copy;
}

/// Lists as (offsets, values).
template <class T>
py::tuple view(const IndexLists<T>& all, py::handle owner) {
    return py::make_tuple(view(all.offsets, owner), view(all.values, owner));
}
inline IndexLists<std::uint32_t> copied_lists(const py::tuple& pair) {
    IndexLists<std::uint32_t> lists;
    lists.offsets = copied<std::uint32_t>(pair[0].cast<py::array>());
    lists.values = copied<std::uint32_t>(pair[1].cast<py::array>());
    return lists;
}

/// (x, y, z)
inline py::tuple to_tuple(const Point3& p) {
    return py::make_tuple(p.x, p.y, p.z);
}
inline Point3 to_point(const py::handle& three) {
    const auto xyz = three.cast<std::array<double, 3>>();
    return {xyz[0], xyz[1], xyz[2]};
}

/// A member of a report as Python gets it: points and lists as tuples, kinds as their names.
template <class T>
py::object shown(const T& value) {
    if constexpr (std::is_base_of_v<py::object, T>)
        return value;
    else if constexpr (std::is_same_v<T, Point3>)
        return to_tuple(value);
    else if constexpr (std::is_same_v<T, std::string>)
        return to_text(value);
    else if constexpr (std::is_enum_v<T>)
        return to_text(name_of(value));
    else if constexpr (std::is_convertible_v<T, std::uint32_t> && !std::is_arithmetic_v<T>)
        return py::int_(std::uint32_t(value)); // a number of something
    else if constexpr (requires { value.size(); })
        return py::tuple(py::cast(value));
    else
        return py::cast(value);
}

/// A tuple of the members that each report describes.
template <class Items>
py::list rows(const Items& reports) {
    py::list all;
    for (const auto& report : reports) {
        py::list row;
        each_member(report,
                    [&row](std::string_view, const auto& value) { row.append(shown(value)); });
        all.append(py::tuple(row));
    }
    return all;
}

/// A dict of the members that a report describes; lists stay lists.
template <Described Report>
py::dict dict_of(const Report& report) {
    py::dict all;
    each_member(report, [&all]<class T>(std::string_view name, const T& value) {
        if constexpr (Described<T>)
            all[to_text(name)] = dict_of(value);
        else if constexpr (requires { value.size(); } && !std::is_same_v<T, std::string>)
            all[to_text(name)] = py::cast(value);
        else
            all[to_text(name)] = shown(value);
    });
    return all;
}

/// A tuple of these members, or of what these functions return, for each item.
template <class Items, class... Members>
requires(sizeof...(Members) > 0) py::list rows(const Items& items, Members... members) {
    py::list all;
    for (const auto& item : items) all.append(py::make_tuple(shown(std::invoke(members, item))...));
    return all;
}

/// See arrays_of().
template <class Bound, class Part>
struct ArraysOf {
    Bound& bound;
    Part part;

    template <class Member>
    const ArraysOf& add(const char* name, Member member) const {
        bound.def_property_readonly(name, [part = part, member](const py::object& self) {
            const auto& handle = self.cast<const typename Bound::type&>();
            return view(std::invoke(member, std::invoke(part, handle)), self);
        });
        return *this;
    }
};
/// Adds properties that are views of vectors, or pairs of views of lists: members of a part of a handle, which is a
/// member of it or what a function returns.
template <class Bound, class Part>
ArraysOf<Bound, Part> arrays_of(Bound& bound, Part part) {
    return {bound, part};
}

} // namespace terrane::python
