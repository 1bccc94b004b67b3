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

py::list to_texts(const std::vector<std::string>& texts) {
    py::list all;
    for (const std::string& text : texts) all.append(to_text(text));
    return all;
}

} // namespace terrane::python
