(* SPDX-License-Identifier: Apache-2.0 *)
(* The data model of the flight computer, for Frama-C 25.

   What is proved must be what is built. Frama-C's own machines are PCs: their
   char is signed, their long double has 10 or 12 bytes, their doubles may lie
   on 4-byte boundaries. This one is the Cortex-M7 as arm-none-eabi-gcc 12.2
   sees it under the AAPCS, with the flags the firmware is built with.

   No value is taken from another machine: a field that Frama-C adds or renames
   must break the compilation of this file, not be inherited from a PC.
   tests/machdep/check_machdep.py compares every value with the compiler.

   The size of enumerations is not part of this record: pass
   [-enums gcc-short-enums] beside [-machdep keel_cortex_m7]. *)

let keel_cortex_m7 : Cil_types.mach =
  {
    version = "arm-none-eabi-gcc 12.2, Cortex-M7, hard float, AAPCS";
    compiler = "gcc";
    (* The flags of the firmware build. Frama-C passes them to a preprocessor it
       knows; tools/keel tools gives them to the cross compiler itself. *)
    cpp_arch_flags =
      [ "-mcpu=cortex-m7"; "-mthumb"; "-mfpu=fpv5-d16"; "-mfloat-abi=hard" ];
    sizeof_short = 2;
    sizeof_int = 4;
    sizeof_long = 4;
    sizeof_longlong = 8;
    sizeof_ptr = 4;
    sizeof_float = 4;
    sizeof_double = 8;
    sizeof_longdouble = 8;
    (* GNU extensions: sizeof(void) and sizeof of a function are 1. *)
    sizeof_void = 1;
    sizeof_fun = 1;
    size_t = "unsigned int";
    wchar_t = "unsigned int";
    ptrdiff_t = "int";
    alignof_short = 2;
    alignof_int = 4;
    alignof_long = 4;
    alignof_longlong = 8;
    alignof_ptr = 4;
    alignof_float = 4;
    alignof_double = 8;
    alignof_longdouble = 8;
    alignof_str = 1;
    (* Thumb code lies on half-words. *)
    alignof_fun = 2;
    (* __attribute__((aligned)) without a value: __BIGGEST_ALIGNMENT__. *)
    alignof_aligned = 8;
    char_is_unsigned = true;
    underscore_name = false;
    const_string_literals = true;
    little_endian = true;
    has__builtin_va_list = true;
  }

let () = File.new_machdep "keel_cortex_m7" keel_cortex_m7
