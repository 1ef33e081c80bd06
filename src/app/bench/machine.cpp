#include "app/bench/machine.h"

#include <elf.h>
#include <link.h>

#include <array>
#include <cstring>
#include <ctime>

#include "app/system_info.h"
#include "app/version.h"
#include "core/parallel.h"
#include "geometry/embree/bare_embree.h"
#include "geometry/embree/embree.h"

namespace lancer {
namespace {

std::string now_text()
{
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text.data();
}

std::string hexadecimal(const unsigned char* bytes, size_t count)
{
    std::string text;
    for (size_t i = 0; i < count; ++i)
        for (const int nibble : {bytes[i] >> 4, bytes[i] & 15}) text += "0123456789abcdef"[nibble];
    return text;
}

// The linker's build id among the notes of an object; empty if it is not there.
std::string build_id_in(const char* notes, size_t size)
{
    const auto padded = [](size_t n) { return (n + 3) & ~size_t{3}; };
    while (size >= sizeof(ElfW(Nhdr))) {
        ElfW(Nhdr) head;
        std::memcpy(&head, notes, sizeof head);
        const size_t name = sizeof head, description = name + padded(head.n_namesz);
        const size_t all = description + padded(head.n_descsz);
        if (all > size) break;
        if (head.n_type == NT_GNU_BUILD_ID && head.n_namesz == 4 && std::memcmp(notes + name, "GNU", 4) == 0)
            return hexadecimal(reinterpret_cast<const unsigned char*>(notes) + description, head.n_descsz);
        notes += all, size -= all;
    }
    return {};
}

// Of the program, the first object that the loader names.
std::string build_id()
{
    std::string id;
    dl_iterate_phdr(
        [](dl_phdr_info* info, size_t, void* out) {
            for (size_t i = 0; i < info->dlpi_phnum; ++i) {
                const ElfW(Phdr)& part = info->dlpi_phdr[i];
                auto& found = *static_cast<std::string*>(out);
                if (part.p_type == PT_NOTE && found.empty())
                    found = build_id_in(reinterpret_cast<const char*>(info->dlpi_addr + part.p_vaddr), part.p_memsz);
            }
            return 1;
        },
        &id);
    return id;
}

}  // namespace

MachineBlock measure_machine(const std::string& executable, unsigned threads, const std::string& isa)
{
    MachineBlock m;
    m.date = now_text();
    m.cpu = cpu_model();
    m.num_cpus = static_cast<int>(available_threads());
    m.threads = static_cast<int>(threads);
    m.load = load_average();
    m.compiler = compiler_text(), m.flags = LANCER_FLAGS;
    m.embree = embree_version(), m.embree_isa = isa, m.widest_isa = widest_isa();
    m.embree_asserts = embree_has_asserts();
    m.tbb = parallel_version();
    m.executable = executable, m.lancer = LANCER_VERSION, m.build_id = build_id();
    return m;
}

}  // namespace lancer
