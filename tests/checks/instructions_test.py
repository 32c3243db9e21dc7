import unittest

from instructions import violations, violations_of


def disassembly(function, *instructions):
    return [f"0000000000402f10 <{function}>:", *(f"  402f1{k}:\t{text}"
                                                 for k, text in enumerate(instructions)), ""]


class PlantedViolations(unittest.TestCase):
    def test_what_every_processor_has(self):
        self.assertEqual(violations(disassembly(
            "std::vector<double>::size() const", "movsd  (%rdi),%xmm0", "verr   %ax",
            "rep stos %al,%es:(%rdi)", "sqrtpd %xmm0,%xmm0", "call   402f10 <vmovd>")), [])
        for name in ("addpd addsd movsl movntdq movntpd pmaxub pmaxsw pminub pminsw pinsrw pextrw packuswb packssdw "
                     "pmaddwd pmuludq pmulhuw pmulhw pmullw pcmpeqd pcmpgtd pshufd pshuflw shufpd unpckhpd psadbw "
                     "pandn andnpd movmskpd cmpxchg cmpxchg8b bsf tzcnt adc fistp sar shld").split():
            self.assertEqual(violations(disassembly("f()", f"{name}  %xmm0,%xmm1")), [], name)

    def test_a_level(self):
        self.assertEqual(violations(disassembly(
            "double listric::dem::fast::v4::(anonymous namespace)::sweep<true>(Strip&)",
            "vmulpd %zmm0,%zmm1,%zmm2", "kmovb  %k1,%eax", "shlx   %rax,%rbx,%rcx")), [])

    def test_a_template_that_a_level_compiled_for_all(self):
        for instruction in ("vmovsd (%rdi),%xmm0", "kmovb  %k1,%eax", "bzhi   %rax,%rbx,%rcx",
                            "lock popcnt %rax,%rbx"):
            self.assertEqual(violations(disassembly(
                "listric::dem::fast::baseline::(anonymous namespace)::sweep(Strip&)", "ret",
                instruction)),
                ["listric::dem::fast::baseline::(anonymous namespace)::sweep(Strip&): "
                 + instruction.split()[-2]])

    def test_every_later_extension(self):
        for name in ("addsubpd haddpd hsubps lddqu movddup movshdup movsldup fisttpll "
                     "pabsd palignr phaddd phsubw pmaddubsw pmulhrsw pshufb psignb "
                     "blendpd blendvpd pblendw pblendvb dppd extractps insertps movntdqa mpsadbw packusdw pcmpeqq "
                     "pextrb pextrd pextrq phminposuw pinsrb pinsrd pinsrq pmaxsb pmaxsd pmaxuw pmaxud pminsb pminsd "
                     "pminuw pminud pmovsxbw pmovzxdq pmuldq pmulld ptest roundsd roundps "
                     "crc32b pcmpgtq pcmpestri pcmpistrm popcnt cmpxchg16b sahf aesenc sha1msg1 adcx").split():
            self.assertEqual(violations(disassembly("f()", f"{name}  %xmm0,%xmm1")), [f"f(): {name}"])

    def test_fused_multiply_add(self):
        name = "listric::dem::fast::v4::(anonymous namespace)::sweep(Strip&)"
        self.assertEqual(violations(disassembly(name, "vfmadd231pd %zmm0,%zmm1,%zmm2")),
                         [f"{name}: vfmadd231pd"])

    def test_a_program_that_cannot_be_read(self):
        self.assertEqual(violations([]), ["has no instructions"])
        for program in ("/nowhere", __file__):
            self.assertEqual(violations_of(program), ["has no instructions", "objdump fails with exit code 1"])


if __name__ == "__main__":
    unittest.main()
