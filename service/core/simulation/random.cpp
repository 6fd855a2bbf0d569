namespace gyrod {}
