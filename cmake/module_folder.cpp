// SPDX-License-Identifier: Apache-2.0
// Compiled into every program that uses this installation of fastrt: where it keeps the modules that read and
// write some kinds of pictures. Weak, for parts of a program may each bring it along.
extern "C" __attribute__((weak)) const char fastrt_module_folder[];
const char fastrt_module_folder[] = FASTRT_MODULE_FOLDER;
