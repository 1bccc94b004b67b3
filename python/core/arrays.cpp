// SPDX-License-Identifier: LGPL-3.0-or-later
#include "arrays.hpp"

namespace terrane::python {

py::str to_text(std::string_view text) {
    PyObject* made =
        PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape");
    if (made == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(made);
}

std::string from_text(py::handle text) {
    if (PyUnicode_Check(text.ptr()) == 0)
        throw py::type_error(
            "a name is a str, not " +
            py::str(py::type::handle_of(text).attr("__name__")).cast<std::string>());
    const auto bytes = py::reinterpret_steal<py::bytes>(
        PyUnicode_AsEncodedString(text.ptr(), "utf-8", "surrogateescape"));
    if (!bytes) throw py::error_already_set();
    return bytes;
}

std::filesystem::path to_path(py::handle path) {
    PyObject* bytes = nullptr;
    if (PyUnicode_FSConverter(path.ptr(), &bytes) == 0) throw py::error_already_set();
    return std::string(py::reinterpret_steal<py::bytes>(bytes));
}

void require_rows(const py::array& array, const py::dtype& type, std::size_t length) {
    const bool has_rows =
        length == 0 ? array.ndim() == 1
                    : array.ndim() == 2 && array.shape(1) == static_cast<py::ssize_t>(length);
    if (has_rows && py::detail::npy_api::get().PyArray_EquivTypes_(array.dtype().ptr(), type.ptr()))
        return;
    const std::string shape = length == 0 ? "(n,)" : "(n, " + std::to_string(length) + ")";
    throw py::value_error("an array of " + std::string(py::str(py::handle(type))) +
                          " with the shape " + shape + " is needed, not of " +
                          std::string(py::str(array.dtype())) + " with " +
                          std::string(py::str(array.attr("shape"))));
}

py::list to_texts(const std::vector<std::string>& texts) {
    py::list all;
    for (const std::string& text : texts) all.append(to_text(text));
    return all;
}

} // namespace terrane::python
