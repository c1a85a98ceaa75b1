/* The bytes of TILEPRESS_FONT as kEmbeddedFont. */
	.section .rodata
	.global kEmbeddedFont
	.hidden kEmbeddedFont
	.balign 16
kEmbeddedFont:
	.incbin TILEPRESS_FONT
	.section .note.GNU-stack, "", %progbits
