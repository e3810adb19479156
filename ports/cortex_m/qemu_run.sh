#!/bin/sh
# qemu_run.sh IMAGE: runs an image on an emulated Cortex-M4F and exits as it does. 124: it did not end in time.
# -icount shift=0: one instruction is one virtual nanosecond, so the board's timer counts instructions.
exec timeout "${HYST_QEMU_SECONDS:-120}" qemu-system-arm -M mps2-an386 -nographic -monitor none -serial none \
    -chardev stdio,id=console -semihosting-config enable=on,target=native,chardev=console \
    -icount shift=0 -kernel "$1" </dev/null
