#include "apps/page/hdf5_image.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace listric {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr std::uint64_t nowhere = ~std::uint64_t{0};
constexpr std::size_t superblock_size = 96;

/// Bytes of integers one after another.
template <class... T> std::string packed(T... values) {
    std::string text;
    (text.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
    return text;
}

constexpr std::uint8_t operator""_byte(unsigned long long value) {
    return static_cast<std::uint8_t>(value);
}

/// A text filled up to a multiple of 8 bytes.
std::string padded(std::string text) {
    text.resize((text.size() + 7) / 8 * 8, '\0');
    return text;
}

std::string space_message(const std::optional<std::uint64_t>& rows) {
    const std::string head =
        packed(1_byte, rows ? 1_byte : 0_byte, 0_byte, 0_byte, std::uint32_t{0});
    return rows ? head + packed(*rows) : head;
}

/// A file that grows.
class Image {
public:
    explicit Image(const Hdf5Object& root) : bytes_(superblock_size) {
        const std::uint64_t at = put_object(root);
        // Version 0; 8 bytes for places and sizes; 4 and 16 are of groups of a kind that is not
        // here.
        const std::string head =
            "\x89HDF\r\n\x1a\n" + std::string(5, '\0') + packed(8_byte, 8_byte, 0_byte) +
            packed(std::uint16_t{4}, std::uint16_t{16}, std::uint32_t{0}, std::uint64_t{0}, nowhere,
                   std::uint64_t{bytes_.size()}, nowhere) +
            packed(std::uint64_t{0}, at, std::uint32_t{0});
        std::memcpy(bytes_.data(), head.data(), head.size());
    }
    std::vector<std::byte> taken() && { return std::move(bytes_); }

private:
    std::uint64_t put(const void* data, std::size_t size) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + (size + 7) / 8 * 8);
        if (size > 0)
            std::memcpy(bytes_.data() + at, data, size);
        return at;
    }

    /// A header with messages, after what they refer to.
    std::uint64_t put_object(const Hdf5Object& object) {
        std::uint16_t count = 0;
        std::string messages;
        const auto add = [&](std::uint16_t kind, std::string message) {
            message = padded(std::move(message));
            messages += packed(kind, static_cast<std::uint16_t>(message.size()), std::uint32_t{0}) +
                        message;
            ++count;
        };
        if (object.data)
            add_data(*object.data, add);
        else
            add_members(object, add);
        for (const auto& [name, data] : object.attributes) {
            const std::string space = space_message(data.rows);
            add(0x000c, packed(1_byte, 0_byte, static_cast<std::uint16_t>(name.size() + 1),
                               static_cast<std::uint16_t>(data.type.size()),
                               static_cast<std::uint16_t>(space.size())) +
                            padded(name + '\0') + padded(data.type) + padded(space) +
                            std::string(reinterpret_cast<const char*>(data.bytes.data()),
                                        data.bytes.size()));
        }
        const std::string header =
            packed(1_byte, 0_byte, count, std::uint32_t{1},
                   static_cast<std::uint32_t>(messages.size()), std::uint32_t{0}) +
            messages;
        return put(header.data(), header.size());
    }

    void add_data(const Hdf5Data& data, auto&& add) {
        const std::uint64_t at =
            data.bytes.empty() ? nowhere : put(data.bytes.data(), data.bytes.size());
        add(0x0001, space_message(data.rows));
        add(0x0003, data.type);
        add(0x0005, packed(2_byte, 2_byte, 2_byte, 0_byte)); // of no value to fill with
        add(0x0008, packed(3_byte, 1_byte, at, std::uint64_t{data.bytes.size()}));
    }

    void add_members(const Hdf5Object& group, auto&& add) {
        add(0x0002, packed(0_byte, 0_byte, nowhere, nowhere)); // its links are messages
        add(0x000a, packed(0_byte, 0_byte));
        for (const Hdf5Object& member : group.members) {
            const std::uint64_t at = put_object(member);
            add(0x0006, packed(1_byte, 1_byte, static_cast<std::uint16_t>(member.name.size())) +
                            member.name + packed(at));
        }
    }

    std::vector<std::byte> bytes_;
};

} // namespace

Hdf5Object& Hdf5Object::add(std::string member, std::optional<Hdf5Data> its) {
    return members.emplace_back(Hdf5Object{.name = std::move(member), .data = std::move(its)});
}

Hdf5Data hdf5_text(std::string_view text, bool is_utf8) {
    std::vector<std::byte> bytes(
        std::max<std::size_t>(text.size(), 1)); // HDF5 has none of no length
    std::memcpy(bytes.data(), text.data(), text.size());
    return {packed(0x13_byte, is_utf8 ? 0x10_byte : 0_byte, 0_byte, 0_byte,
                   static_cast<std::uint32_t>(bytes.size())),
            {},
            std::move(bytes)};
}

std::string hdf5_number_type(std::size_t bytes, bool is_float, bool is_signed) {
    const auto size = static_cast<std::uint32_t>(bytes);
    const auto bits = static_cast<std::uint16_t>(8 * bytes);
    if (!is_float)
        return packed(0x10_byte, is_signed ? 0x08_byte : 0_byte, 0_byte, 0_byte, size,
                      std::uint16_t{0}, bits);
    const bool is_double = bytes == 8;
    return packed(0x11_byte, 0x20_byte, static_cast<std::uint8_t>(bits - 1), 0_byte, size,
                  std::uint16_t{0}, bits) +
           (is_double ? packed(52_byte, 11_byte, 0_byte, 52_byte, std::uint32_t{1023})
                      : packed(23_byte, 8_byte, 0_byte, 23_byte, std::uint32_t{127}));
}

std::vector<std::byte> hdf5_image(const Hdf5Object& root) { return Image(root).taken(); }

} // namespace listric
